// SPDX-License-Identifier: GPL-3.0-or-later
// A user's rasterizer as a sink of the geometry stage, in a process of its own where it can do no harm.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/framebuffer.h"
#include "core/screen_polygon.h"
#include "isolate/isolation.h"
#include "plugin/plugin_rasterizer.h"

namespace farop {

/// What a rasterizer says of itself, safe to print.
struct PluginDescription {
  std::string name, summary;
  std::uint32_t abi_version = 0, wants = 0;
};

struct RunnerReport {
  PluginTimes runner;  ///< as the runner says: good for tuning, not for marks
  double judge = 0;    ///< from begin_frame() to the end of end_frame() on this side, geometry included
  double cpu = 0;      ///< of the runner's process, all threads
  std::uint64_t peak_bytes = 0;        ///< resident; 0 while it runs
  std::string out, err;                ///< what it printed, first 64 KiB each, safe to print
  std::vector<IsolationLayer> layers;  ///< 0 and A to E: what stood
};

/// Mirrors PluginRasterizer: frames one after another, of the size of the samples, polygons by the hundred
/// to the runner, which draws them while this process goes on. Only pixels count: whatever else the runner
/// says is a hint.
///
/// begin_frame(), polygons() and end_frame() throw PluginFailure for what the rasterizer did (perhaps some
/// polygons late), Error(ExitStatus::surroundings) for what the machine cannot do. After either the frame is
/// lost; begin_frame() may be called again and, where the runner is gone, starts another one.
/// Not for use by several threads at once. Leaves no process, descriptor or memory behind.
class IsolatedRasterizer : public ScreenPolygonSink {
 public:
  /// Starts the runner, loads `library` (a path) there and creates the rasterizer.
  IsolatedRasterizer(const std::string& library, const IsolationOptions& options,
                     const PluginDrawing& drawing);
  ~IsolatedRasterizer() override;
  IsolatedRasterizer(const IsolatedRasterizer&) = delete;
  IsolatedRasterizer& operator=(const IsolatedRasterizer&) = delete;

  const PluginDescription& description() const;
  PolygonWants wants() const override;
  void begin_frame(const ScreenFrame& frame) override;
  void polygons(const ScreenPolygonBatch& batch) override;
  void end_frame() override;

  /// False for one that draws elsewhere: there is no picture to take.
  bool draws_here() const;
  /// The finished picture, once per frame.
  Framebuffer take();

  /// What spoiled nothing but should be known, in order of discovery: limit.output, limit.syscall,
  /// oob.* found beside the pixels, changed processor state ...
  const std::vector<PluginFinding>& findings() const;
  RunnerReport report() const;

 private:
  class Judge;
  std::unique_ptr<Judge> judge_;
};

}  // namespace farop
