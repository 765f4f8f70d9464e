// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons of a frame in, a picture out: the internal rasterizer, a user's library, or a user's program.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/color.h"
#include "core/framebuffer.h"
#include "core/screen_polygon.h"
#include "raster/internal_rasterizer.h"
#include "rasterizer_options.h"
#include "session.h"

namespace farop::app {

class Drawer {
 public:
  virtual ~Drawer() = default;
  virtual ScreenPolygonSink& sink() = 0;
  /// As the statistics name it.
  virtual std::string name() const = 0;
  /// The finished picture; nothing from one that draws nothing, or elsewhere.
  virtual std::optional<Framebuffer> take() = 0;
  /// After the frame, or what there was of it: adds what is known of the rasterizer's calls, and says what it
  /// did that it should not have done.
  virtual void report(RunReport::Raster& /*report*/) {}
};

/// What a picture is drawn with. `flat`: each polygon in its first corner's colour (the geometry stage has
/// done it already; a flat file need not have).
struct DrawerOptions {
  DrawMode mode = DrawMode::gouraud;
  int samples = 1;
  Rgb background;
  bool keep_depth = false;
  bool additive_transparency = false;  ///< SIPP's; the internal rasterizer's
  ShadingFrame shading;
};

/// Throws Error(usage) for what the chosen rasterizer cannot do: before any input is read.
void check_drawing(const ChosenRasterizer& rasterizer, const RasterizerOptions& how,
                   const DrawerOptions& options);

/// The last step of a command: throws Error(input) when --check is given and found something, Error(internal)
/// when that was farop's fault.
void end_of_check(const RunReport::Raster& report, const RasterizerOptions& how);

/// Loads or prepares the rasterizer. Throws Error(plugin) when it cannot be loaded.
std::unique_ptr<Drawer> make_drawer(Session& session, const ChosenRasterizer& rasterizer,
                                    const RasterizerOptions& how, const DrawerOptions& options);

}  // namespace farop::app
