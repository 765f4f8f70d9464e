// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles in window coordinates that rasterizers are timed with: standard scenes through the geometry
// stage, and random triangles of one size.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/screen_polygon.h"

namespace farop::bench {

/// A frame, kept to be drawn again and again: 1024 x 1024, 2^24 depths, 8 sub-pixel bits.
struct TriangleScene {
  std::string name;
  ScreenFrame frame;
  std::vector<ScreenPolygonBatch> batches;  ///< triangles only, some 4096 corners each

  std::size_t triangles() const;
  void play(ScreenPolygonSink& sink) const;
};

/// gears 4, gears 8, teapot 12, tetra 8, mount 8 and a million tiny, 100,000 medium and 1000 large triangles.
std::vector<std::string> triangle_scene_names();
TriangleScene make_triangle_scene(const std::string& name);

}  // namespace farop::bench
