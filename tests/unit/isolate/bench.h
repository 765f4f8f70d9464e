// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of this folder share: frames to draw, and a look at what is left behind.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/framebuffer.h"
#include "core/screen_polygon.h"
#include "isolate/isolated_rasterizer.h"

namespace farop::test {

std::string plugin_path(const std::string& name);
IsolationOptions options_for_tests();

/// Frame of the samples, and polygons by the batch.
struct Drawing {
  ScreenFrame frame;
  std::vector<ScreenPolygonBatch> batches;
};

/// Random triangles, the same for the same arguments; corners on the frame.
Drawing triangles(int width, int height, std::uint32_t count, std::uint32_t per_batch, int subpixel_bits = 0,
                  std::uint64_t seed = 7);

void draw(ScreenPolygonSink& sink, const Drawing& drawing);

/// Descriptors, children and mapped shared memory of this process.
struct Belongings {
  std::set<std::string> descriptors, children, memories;
  friend bool operator==(const Belongings&, const Belongings&) = default;
};
Belongings belongings();

/// Processes of any parent that run the given program.
std::set<int> processes_running(const std::string& program);

/// The runner under test: a copy that belongs to this test program alone, so that its processes can be told
/// from those of tests that run at the same time.
const std::string& own_runner();

/// Draws a frame of 16 * scale pixels (or several) with the sinner; the finding that ended it, or the first
/// that did not, or one with the verdict "pass".
PluginFinding sin_finding(const std::string& sin, IsolationOptions options = options_for_tests(),
                          int sinful_frame = 0, int frames = 1, int scale = 1);

}  // namespace farop::test
