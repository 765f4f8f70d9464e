// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/plugin_rasterizer.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/error.h"

namespace farop {
namespace {

/// Draws every corner as a pixel of its colour and fails where it is told to.
struct Dots {
  farop_frame frame{};
  std::vector<std::uint32_t> numbers;
  int created = 0, destroyed = 0;
  const char* fail_in = "";
  const farop_host* host = nullptr;
} g_dots;

farop_status outcome(const char* function) {
  if (std::string_view(g_dots.fail_in) != function) return FAROP_OK;
  g_dots.host->log(g_dots.host, FAROP_LOG_ERROR, "dots: told to fail");
  g_dots.host->log(g_dots.host, FAROP_LOG_INFO, "and some more words");
  return FAROP_E_UNSUPPORTED;
}

farop_rasterizer dots_table() {
  farop_rasterizer table{};
  table.struct_size = sizeof table;
  table.abi_version = FAROP_ABI_VERSION;
  table.name = "dots";
  table.create = [](const farop_host* host, void**) -> farop_status {
    g_dots.host = host;
    ++g_dots.created;
    return outcome("create");
  };
  table.destroy = [](void*) { ++g_dots.destroyed; };
  table.begin_frame = [](void*, const farop_frame* frame) -> farop_status {
    g_dots.frame = *frame;
    g_dots.numbers.push_back(frame->number);
    return outcome("begin_frame");
  };
  table.polygon = [](void*, const farop_polygon* p) -> farop_status {
    for (std::uint32_t i = 0; i < p->vertex_count; ++i) {
      const farop_vertex& v = p->vertices[i];
      std::uint8_t* pixel = g_dots.frame.pixels + v.y * g_dots.frame.row_bytes + 3 * v.x;
      pixel[0] = v.r, pixel[1] = v.g, pixel[2] = v.b;
    }
    return p->index == 1 ? outcome("polygon") : FAROP_OK;
  };
  table.end_frame = [](void*) -> farop_status { return outcome("end_frame"); };
  return table;
}

struct Bench {
  farop_rasterizer table = dots_table();
  PluginLibrary library;
  HostServices services{{}, {}};
  ScreenFrame frame;
  ScreenPolygonBatch batch;

  Bench() {
    g_dots = {};
    frame.resolution = {4, 2, 65536, 256};
    batch.vertices = {{0, 0, 0, 250, 0, 0, 0}, {3, 0, 0, 0, 250, 0, 0}, {0, 1, 0, 0, 0, 250, 0}};
    batch.polygons.push_back({0, 3, nullptr, false, 0, 0});
    batch.polygons.push_back({0, 3, nullptr, false, 0, 0});
  }
  Framebuffer draw(const PluginDrawing& drawing, int frames = 1) {
    library = check_plugin_table(&table);
    PluginRasterizer rasterizer(library, services, drawing);
    for (int i = 0; i < frames; ++i) {
      rasterizer.begin_frame(frame);
      rasterizer.polygons(batch);
      rasterizer.end_frame();
    }
    return rasterizer.take();
  }
};

std::vector<int> pixel(const Framebuffer& picture, int x, int y) {
  const std::uint8_t* p = &picture.rgb[3 * picture.pixel(x, y)];
  return {p[0], p[1], p[2]};
}

TEST(PluginRasterizer, DrawsOnABackgroundWithTheBottomRowFirst) {
  Bench bench;
  const Framebuffer picture = bench.draw({1, {1, 0.5, 0}}, 3);
  EXPECT_EQ(picture.width, 4);
  EXPECT_EQ(picture.height, 2);
  EXPECT_EQ(pixel(picture, 0, 0), (std::vector<int>{250, 0, 0}));
  EXPECT_EQ(pixel(picture, 3, 0), (std::vector<int>{0, 250, 0}));
  EXPECT_EQ(pixel(picture, 0, 1), (std::vector<int>{0, 0, 250}));
  EXPECT_EQ(pixel(picture, 2, 1), (std::vector<int>{255, 128, 0}));
  EXPECT_EQ(g_dots.numbers, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(g_dots.frame.z_far, 65535);
  EXPECT_EQ(g_dots.created, 1);
  EXPECT_EQ(g_dots.destroyed, 1);
}

TEST(PluginRasterizer, FlipsFramesThatCountFromTheTop) {
  Bench bench;
  bench.frame.y_down = true;
  const Framebuffer picture = bench.draw({});
  EXPECT_EQ(pixel(picture, 0, 1), (std::vector<int>{250, 0, 0}));
  EXPECT_EQ(pixel(picture, 0, 0), (std::vector<int>{0, 0, 250}));
}

TEST(PluginRasterizer, AveragesBlocksOfSamplesRoundedToNearest) {
  Bench bench;
  const Framebuffer picture = bench.draw({2, {0, 0, 0}});
  EXPECT_EQ(picture.width, 2);
  EXPECT_EQ(picture.height, 1);
  EXPECT_EQ(pixel(picture, 0, 0), (std::vector<int>{63, 0, 63}));  // 250 / 4 = 62.5
  EXPECT_EQ(pixel(picture, 1, 0), (std::vector<int>{0, 63, 0}));
}

TEST(PluginRasterizer, FailuresCarryTheFunctionThePolygonAndTheLastWords) {
  const std::string reason = "a request it cannot serve (FAROP_E_UNSUPPORTED): dots: told to fail";
  const std::pair<const char*, std::string> cases[] = {
      {"create", "rasterizer 'dots': create failed: " + reason},
      {"begin_frame", "rasterizer 'dots': begin_frame failed: " + reason},
      {"polygon", "rasterizer 'dots': polygon number 1 failed: " + reason},
      {"end_frame", "rasterizer 'dots': end_frame failed: " + reason}};
  for (const auto& [function, message] : cases) {
    Bench bench;
    g_dots.fail_in = function;
    try {
      bench.draw({});
      ADD_FAILURE() << function << " did not fail";
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), message);
      EXPECT_EQ(error.status(), ExitStatus::plugin);
    }
    // destroy() belongs to every successful create().
    EXPECT_EQ(g_dots.destroyed, std::string_view(function) == "create" ? 0 : 1);
  }
}

}  // namespace
}  // namespace farop
