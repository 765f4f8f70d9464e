// SPDX-License-Identifier: GPL-3.0-or-later
// A user's rasterizer as a sink of the geometry stage, called in this very process.
#pragma once

#include <farop/rasterizer.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "core/color.h"
#include "core/framebuffer.h"
#include "core/screen_polygon.h"
#include "core/statistics.h"
#include "plugin/host_services.h"
#include "plugin/plugin_check.h"
#include "plugin/plugin_library.h"
#include "plugin/polygon_chunk.h"

namespace farop {

/// What a rasterizer asks of the geometry stage.
PolygonWants polygon_wants(const farop_rasterizer& rasterizer);

/// The frame that a rasterizer gets for a frame of the geometry stage; `pixels`, `row_bytes` and `number` are
/// left to the caller.
farop_frame plugin_frame(const ScreenFrame& frame, const Rgb& background);

/// Fills a frame's pixels, and nothing between its rows, with its background.
void clear_frame(const farop_frame& frame);

/// Blocks of degree x degree pixels averaged, each channel rounded to nearest; the picture's rows run upwards
/// whatever `y_down` says of the frame. Width and height of the frame are multiples of `degree`.
Framebuffer average_blocks(const farop_frame& frame, int degree, bool y_down);

/// What a rasterizer took, by function; `polygon` is the sum over all polygons, read per batch.
struct PluginTimes {
  StageTime create, begin_frame, polygon, end_frame;
};

struct PluginDrawing {
  int samples = 1;  ///< degree A of super-sampling, done by the host: the rasterizer draws A times as large
  Rgb background;   ///< limited to 0..1
  TraceLog* trace = nullptr;  ///< every call goes there, polygons by the batch; outlives the rasterizer
  bool check = false;         ///< a PluginCheck stands before the rasterizer
};

/// Frames one after another, as InternalRasterizer: the frame given to begin_frame is that of the samples.
/// Throws Error(ExitStatus::plugin) when the rasterizer returns a negative status, with the polygon's number
/// and its last words; Error(ExitStatus::surroundings) when memory runs out. Nothing protects this process
/// from the rasterizer.
class PluginRasterizer : public ScreenPolygonSink {
 public:
  /// `library` (loaded) and `services` must outlive this.
  PluginRasterizer(const PluginLibrary& library, HostServices& services, const PluginDrawing& drawing);
  ~PluginRasterizer() override;
  PluginRasterizer(const PluginRasterizer&) = delete;
  PluginRasterizer& operator=(const PluginRasterizer&) = delete;

  PolygonWants wants() const override { return polygon_wants(*library_.table); }
  void begin_frame(const ScreenFrame& frame) override;
  void polygons(const ScreenPolygonBatch& batch) override;
  void end_frame() override;

  /// False for one that draws elsewhere: there is no picture to take.
  bool draws_here() const { return (library_.table->wants & FAROP_DRAWS_ELSEWHERE) == 0; }
  /// The finished picture, once per frame.
  Framebuffer take();
  PluginTimes times() const;
  /// Promises that were broken, where drawing.check is set.
  const std::vector<ContractFinding>& findings() const { return findings_; }

 private:
  farop_status create();
  void make_room();
  void check(farop_status status, const char* function) const;

  const PluginLibrary& library_;
  HostServices& services_;
  PluginDrawing drawing_;
  std::optional<PluginCheck> checker_;
  std::vector<ContractFinding> findings_;
  const farop_rasterizer* table_;  ///< the library's, or the checker's
  void* self_ = nullptr;
  bool created_ = false;
  farop_frame frame_{};
  bool y_down_ = false;
  std::vector<std::uint8_t> pixels_;
  PolygonChunk chunk_;
  volatile std::uint32_t current_ = 0;
  StageTimer create_timer_, begin_timer_, polygon_timer_, end_timer_;
};

}  // namespace farop
