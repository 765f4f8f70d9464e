// SPDX-License-Identifier: GPL-3.0-or-later
// Old plug-ins in a host whose structures have grown, and new ones in a host whose have not: this file is
// built twice.
#include <gtest/gtest.h>

#include "plugin/plugin_rasterizer.h"

namespace farop {
namespace {

class Growth : public testing::TestWithParam<const char*> {};

TEST_P(Growth, DrawsTheSamePictureAcrossVersions) {
  HostServices services({}, {});
  const PluginLibrary library = open_plugin(GetParam(), services);
  ASSERT_EQ(library.failure, LoadFailure::none) << library.message;
  ScreenPolygonBatch batch;
  batch.vertices = {{1, 0, 0, 10, 20, 30, 0}, {3, 1, 5, 40, 50, 60, 0}, {2, 2, 9, 70, 80, 90, 0}};
  batch.vertex_ids = {5, 6, 7};
  batch.polygons.push_back({0, 3, nullptr, false, 8, 9});
  ScreenFrame frame;
  frame.resolution = {4, 3, 65536, 256};
  PluginRasterizer rasterizer(library, services, {1, {0, 0, 0}});
  for (int i = 0; i < 2; ++i) {
    rasterizer.begin_frame(frame);
    rasterizer.polygons(batch);
    rasterizer.end_frame();
  }
  std::vector<std::uint8_t> expected(36, 0);
  for (const ScreenVertex& v : batch.vertices) {
    const auto at = static_cast<std::size_t>(3 * (4 * v.y + v.x));
    expected[at] = static_cast<std::uint8_t>(v.r), expected[at + 1] = static_cast<std::uint8_t>(v.g);
    expected[at + 2] = static_cast<std::uint8_t>(v.b);
  }
  EXPECT_EQ(rasterizer.take().rgb, expected);
}

TEST(Sizes, DifferBetweenTheTwoHosts) {
  EXPECT_EQ(sizeof(farop_frame), FAROP_EXPECTED_FRAME_BYTES);
}

INSTANTIATE_TEST_SUITE_P(Plugins, Growth, testing::Values(FAROP_OLD_PLUGIN, FAROP_NEW_PLUGIN),
                         [](const auto& test) { return test.index == 0 ? "Old" : "New"; });

}  // namespace
}  // namespace farop
