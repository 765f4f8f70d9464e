// SPDX-License-Identifier: GPL-3.0-or-later
// A flat file that repeats what a rasterizer failed on.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/screen_polygon.h"
#include "isolate/isolation.h"
#include "rasterizer_options.h"

namespace farop::app {

class Session;

/// Plays a frame's polygons once more into a sink.
using Replay = std::function<void(ScreenPolygonSink& sink)>;

/// Tells the verdict and where a rasterizer failed, and writes NAME.crash.scr in the current folder: all
/// polygons up to the one it failed on, as triangles where it wants those, and the command that draws them.
/// Nothing is written when the failure belongs to no polygon. What cannot be written is said and does not
/// hide the failure itself.
void explain_failure(Session& session, const PluginFailure& failure, const ChosenRasterizer& rasterizer,
                     const Replay& replay);

}  // namespace farop::app
