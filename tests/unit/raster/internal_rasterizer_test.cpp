// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/internal_rasterizer.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <functional>

#include "core/error.h"
#include "raster/reference.h"
#include "shading/material.h"
#include "support/sanitizers.h"
#include "unit/raster/raster_test_support.h"

namespace farop::test {
namespace {

Framebuffer one(const ScreenFrame& frame, const Corners& corners,
                const InternalRasterizerOptions& options = {}) {
  Drawing drawing;
  drawing.add(corners);
  return draw(frame, drawing, options);
}

TEST(InternalRasterizer, GivesTheRoundedBackgroundWithoutPolygons) {
  InternalRasterizerOptions options;
  options.background = {0.078, 0.361, 7};
  const Framebuffer picture = draw(make_frame(3, 2), {}, options);
  EXPECT_EQ(picture.width, 3);
  EXPECT_EQ(picture.height, 2);
  ASSERT_EQ(picture.rgb.size(), 18u);
  EXPECT_EQ(std::vector<std::uint8_t>(picture.rgb.begin(), picture.rgb.begin() + 3),
            (std::vector<std::uint8_t>{20, 92, 255}));
  EXPECT_EQ(picture.depth, std::vector<float>(6, 65536));
}

TEST(InternalRasterizer, PutsRowZeroAtTheBottom) {
  const Framebuffer picture = one(make_frame(8, 8), rectangle(1, 0, 3, 2, 7, 200, 100, 50));
  EXPECT_EQ(red(picture, 1, 0), 200);
  EXPECT_EQ(red(picture, 2, 1), 200);
  EXPECT_EQ(red(picture, 3, 0), 0);
  EXPECT_EQ(red(picture, 1, 2), 0);
  EXPECT_EQ(picture.rgb[3 * picture.pixel(1, 0) + 1], 100);
  EXPECT_EQ(picture.rgb[3 * picture.pixel(1, 0) + 2], 50);
  EXPECT_EQ(picture.depth[picture.pixel(1, 0)], 7);
}

TEST(InternalRasterizer, FlatModeTakesTheFirstCornersColourForAllOfAPolygon) {
  Corners corners = rectangle(0, 0, 6, 6, 100, 200, 0, 0);
  corners[1].r = corners[2].r = corners[3].r = 10;
  Drawing drawing;
  drawing.add(corners);
  InternalRasterizerOptions options;
  options.mode = DrawMode::flat;
  const Framebuffer picture = draw(make_frame(8, 8), drawing, options);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 6; ++x) EXPECT_EQ(red(picture, x, y), 200);
  }
}

TEST(InternalRasterizer, ShowsTheStrictlyNearerAndOfEqualDepthsTheFirst) {
  Drawing drawing;
  drawing.add(rectangle(0, 0, 6, 6, 100, 10, 0, 0));
  drawing.add(rectangle(2, 2, 9, 9, 100, 20, 0, 0));
  drawing.add(rectangle(4, 4, 9, 9, 99, 30, 0, 0));
  drawing.add(rectangle(0, 0, 9, 9, 101, 40, 0, 0));
  const Framebuffer picture = draw(make_frame(12, 12), drawing);
  EXPECT_EQ(red(picture, 1, 1), 10);
  EXPECT_EQ(red(picture, 3, 3), 10);  // the second, equally deep, comes too late
  EXPECT_EQ(red(picture, 7, 3), 20);
  EXPECT_EQ(red(picture, 5, 5), 30);
  EXPECT_EQ(red(picture, 0, 8), 40);
  EXPECT_EQ(red(picture, 10, 10), 0);
}

TEST(InternalRasterizer, DrawsAtTheFarthestDepthAndNothingBeyond) {
  for (const std::int64_t depths : {std::int64_t{2}, std::int64_t{65536}, std::int64_t{1} << 30}) {
    EXPECT_EQ(
        red(one(make_frame(4, 4, 0, depths), rectangle(0, 0, 3, 3, static_cast<int>(depths - 1), 9, 0, 0)), 1,
            1),
        9);
    EXPECT_EQ(
        red(one(make_frame(4, 4, 0, depths), rectangle(0, 0, 3, 3, static_cast<int>(depths), 9, 0, 0)), 1, 1),
        0);
  }
}

TEST(InternalRasterizer, EqualsASearchForTheNearestPolygonAtEveryPixel) {
  Random random(51);
  for (int i = 0; i < 200; ++i) {
    Drawing drawing;
    for (int k = 0; k < 10; ++k) {
      Corners corners = random_polygon(random, k_shapes[random.bits() % 5], 0, 92, 0, 92);
      const int z = random.integer(0, 4);
      for (ScreenVertex& v : corners) v = vertex(v.x, v.y, z, 20 + 20 * k, 0, 0);
      drawing.add(corners);
    }
    const Framebuffer picture = draw(make_frame(24, 24, 2), drawing);
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 24; ++x) {
        int nearest = 65536, color = 0;
        for (const ScreenPolygonRecord& record : drawing.batch.polygons) {
          const auto corners = drawing.batch.corners(record);
          if (!reference::covers(corners, 2, x, y) || corners[0].z >= nearest) continue;
          nearest = corners[0].z, color = corners[0].r;
        }
        ASSERT_EQ(red(picture, x, y), color) << "scene " << i << " at " << x << ' ' << y;
        ASSERT_EQ(picture.depth[picture.pixel(x, y)], static_cast<float>(nearest));
      }
    }
  }
}

TEST(InternalRasterizer, ConvertsOtherColourResolutionsToEightBits) {
  for (const int colors : {2, 64, 128, 256, 512, 65536}) {
    for (const int c : {0, 1, colors / 3, colors / 2, colors - 2, colors - 1}) {
      const Framebuffer picture = one(make_frame(4, 4, 0, 65536, colors), rectangle(0, 0, 3, 3, 5, c, 0, 0));
      // round(255 c / (CRES - 1)) in integers
      EXPECT_EQ(red(picture, 1, 1), (2 * 255 * c + colors - 1) / (2 * (colors - 1))) << c << " of " << colors;
    }
  }
}

TEST(InternalRasterizer, AveragesRoundedSamplesAndKeepsTheNearestDepth) {
  Random random(52);
  const Material glass{.transmittance = 0.4};
  for (const int degree : {1, 2, 3, 5, 16}) {
    constexpr int k_width = 7, k_height = 5;
    const int w = k_width * degree, h = k_height * degree;
    Drawing drawing;
    for (int k = 0; k < 12; ++k) {
      Corners corners = random_polygon(random, k_shapes[k % 5], 0, w * 16 - 1, 0, h * 16 - 1);
      for (ScreenVertex& v : corners) {
        v = vertex(v.x, v.y, random.integer(0, 65535), random.integer(0, 255), random.integer(0, 255), 8);
      }
      drawing.add(corners, k % 4 == 3 ? &glass : nullptr);
    }
    InternalRasterizerOptions options;
    options.background = {0.5, 0.25, 0.125};
    const Framebuffer fine = draw(make_frame(w, h, 4), drawing, options);
    options.samples = degree;
    const Framebuffer mean = draw(make_frame(w, h, 4), drawing, options);
    ASSERT_EQ(mean.width, k_width);
    ASSERT_EQ(mean.height, k_height);
    for (int y = 0; y < k_height; ++y) {
      for (int x = 0; x < k_width; ++x) {
        for (std::size_t c = 0; c < 3; ++c) {
          double sum = 0;
          float nearest = 65536;
          for (int i = 0; i < degree * degree; ++i) {
            const std::size_t sample = fine.pixel(x * degree + i % degree, y * degree + i / degree);
            sum += fine.rgb[3 * sample + c];
            nearest = std::min(nearest, fine.depth[sample]);
          }
          ASSERT_EQ(mean.rgb[3 * mean.pixel(x, y) + c], std::floor(sum / (degree * degree) + 0.5));
          ASSERT_EQ(mean.depth[mean.pixel(x, y)], nearest);
        }
      }
    }
  }
}

TEST(InternalRasterizer, RoundsAMeanOfOneHalfUpwards) {
  InternalRasterizerOptions options;
  options.samples = 2;
  const Framebuffer picture = one(make_frame(4, 4), rectangle(0, 0, 1, 2, 5, 201, 0, 0), options);
  EXPECT_EQ(red(picture, 0, 0), 101);  // 402 / 4 = 100.5
}

void draw_the_same_frame_again(RasterPath path) {
  InternalRasterizerOptions options;
  options.tuning.path = path;
  InternalRasterizer rasterizer(options);
  const auto frame_of = [&](int size, int z, int r) {
    Drawing drawing;
    drawing.add(rectangle(0, 0, size - 1, size - 1, z, r, 0, 0));
    rasterizer.begin_frame(make_frame(size, size));
    rasterizer.polygons(drawing.batch);
    rasterizer.end_frame();
    return rasterizer.take().rgb;
  };
  const auto first = frame_of(20, 50, 99);
  frame_of(33, 3, 1);
  EXPECT_EQ(frame_of(20, 50, 99), first);
  EXPECT_EQ(rasterizer.counts().polygons, 1u);
  EXPECT_EQ(rasterizer.counts().fragments, path == RasterPath::plain ? 19u * 19 : 0);
}

TEST(InternalRasterizer, DrawsTheSameFrameAgainAfterAnother) {
  draw_the_same_frame_again(RasterPath::plain);
  draw_the_same_frame_again(RasterPath::tiled);
}

TEST(InternalRasterizer, LeavesDepthOutUnlessAsked) {
  InternalRasterizer rasterizer({});
  rasterizer.begin_frame(make_frame(5, 5));
  rasterizer.end_frame();
  EXPECT_TRUE(rasterizer.take().depth.empty());
}

TEST(InternalRasterizer, SurvivesAnyVertices) {
  Random random(53);
  const Material glass{.transmittance = 0.5};
  for (int i = 0; i < 2000; ++i) {
    Drawing drawing;
    for (int k = 0; k < 3; ++k) {
      Corners corners(static_cast<std::size_t>(random.integer(0, 9)));
      for (ScreenVertex& v : corners) {
        const int shift = random.integer(0, 31);
        v.x = static_cast<std::int32_t>(random.bits()) >> shift,
        v.y = static_cast<std::int32_t>(random.bits()) >> shift;
        v.z = static_cast<std::int32_t>(random.bits());
        v.r = static_cast<std::uint16_t>(random.bits()), v.g = static_cast<std::uint16_t>(random.bits());
      }
      drawing.add(corners, k == 0 ? &glass : nullptr);
    }
    EXPECT_EQ(draw(make_frame(random.integer(1, 30), random.integer(1, 30), i % 9), drawing).depth.empty(),
              false);
  }
}

ExitStatus status_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.status();
  }
  return ExitStatus::ok;
}

TEST(InternalRasterizer, RefusesWhatBreaksItsContract) {
  const auto begin = [](const ScreenFrame& frame, int samples = 1) {
    return status_of([&] {
      InternalRasterizerOptions options;
      options.samples = samples;
      InternalRasterizer(options).begin_frame(frame);
    });
  };
  EXPECT_EQ(begin(make_frame(6, 6)), ExitStatus::ok);
  ScreenFrame down = make_frame(6, 6);
  down.y_down = true;
  EXPECT_EQ(begin(down), ExitStatus::internal);
  EXPECT_EQ(begin(make_frame(0, 6)), ExitStatus::internal);
  EXPECT_EQ(begin(make_frame(32768, 1)), ExitStatus::internal);
  EXPECT_EQ(begin(make_frame(32768, 2), 2), ExitStatus::ok);
  EXPECT_EQ(begin(make_frame(6, 6), 4), ExitStatus::internal);
  EXPECT_EQ(begin(make_frame(17, 17), 17), ExitStatus::internal);
  EXPECT_EQ(begin(make_frame(6, 6), 0), ExitStatus::internal);
  EXPECT_EQ(begin(make_frame(6, 6, 9)), ExitStatus::internal);
  EXPECT_EQ(begin(make_frame(6, 6, 0, 1)), ExitStatus::internal);
  EXPECT_EQ(begin(make_frame(6, 6, 0, 2, 1)), ExitStatus::internal);
}

TEST(InternalRasterizer, RefusesCallsInTheWrongOrderAndIncompleteBatches) {
  InternalRasterizer rasterizer({});
  EXPECT_EQ(status_of([&] { rasterizer.polygons({}); }), ExitStatus::internal);
  EXPECT_EQ(status_of([&] { rasterizer.end_frame(); }), ExitStatus::internal);
  EXPECT_EQ(status_of([&] { rasterizer.take(); }), ExitStatus::internal);
  rasterizer.begin_frame(make_frame(6, 6));
  EXPECT_EQ(status_of([&] { rasterizer.take(); }), ExitStatus::internal);
  Drawing drawing;
  drawing.add(rectangle(0, 0, 3, 3, 5, 1, 2, 3));
  drawing.batch.vertices.pop_back();
  EXPECT_EQ(status_of([&] { rasterizer.polygons(drawing.batch); }), ExitStatus::internal);

  InternalRasterizerOptions options;
  options.mode = DrawMode::phong;
  InternalRasterizer phong(options);
  phong.begin_frame(make_frame(6, 6));
  Drawing bare;
  bare.add(rectangle(0, 0, 3, 3, 5, 1, 2, 3));
  EXPECT_EQ(status_of([&] { phong.polygons(bare.batch); }), ExitStatus::internal);
}

// Each runs in a process of its own, with 1 GiB of address space.
template <class Action>
[[noreturn]] void run_with_little_memory(Action action) {
  const rlimit limit{1u << 30, 1u << 30};
  setrlimit(RLIMIT_AS, &limit);
  std::exit(static_cast<int>(status_of(action)));
}

TEST(InternalRasterizerDeathTest, ReportsAFrameThatDoesNotFitIntoMemory) {
  if (k_address_sanitizer) GTEST_SKIP() << "AddressSanitizer ends a process that runs out of memory";
  const auto begin = [](DrawMode mode, int size, int samples) {
    run_with_little_memory([&] {
      InternalRasterizerOptions options;
      options.mode = mode;
      options.samples = samples;
      InternalRasterizer rasterizer(options);
      rasterizer.begin_frame(make_frame(size * samples, size * samples));
    });
  };
  const auto surroundings = testing::ExitedWithCode(static_cast<int>(ExitStatus::surroundings));
  EXPECT_EXIT(begin(DrawMode::gouraud, 32767, 1), surroundings, "");
  EXPECT_EXIT(begin(DrawMode::phong, 32767, 16), surroundings, "");
  EXPECT_EXIT(begin(DrawMode::line, 32767, 1), surroundings, "");
  EXPECT_EXIT(begin(DrawMode::gouraud, 1000, 1), testing::ExitedWithCode(0), "");
}

TEST(InternalRasterizerDeathTest, ReportsTransparentLayersThatDoNotFitIntoMemory) {
  if (k_address_sanitizer) GTEST_SKIP() << "AddressSanitizer ends a process that runs out of memory";
  const auto draw_layers = [](RasterPath path, std::size_t waiting_bytes) {
    run_with_little_memory([&] {
      const Material glass{.transmittance = 0.5};
      Drawing drawing;
      drawing.add(rectangle(0, 0, 999, 999, 5, 1, 2, 3), &glass);
      InternalRasterizerOptions options;
      options.tuning.path = path;
      options.tuning.threads = 1;
      options.tuning.waiting_bytes = waiting_bytes;
      InternalRasterizer rasterizer(options);
      rasterizer.begin_frame(make_frame(1000, 1000));
      for (int i = 0; i < 100; ++i) rasterizer.polygons(drawing.batch);
    });
  };
  const auto surroundings = testing::ExitedWithCode(static_cast<int>(ExitStatus::surroundings));
  EXPECT_EXIT(draw_layers(RasterPath::plain, 0), surroundings, "");
  EXPECT_EXIT(draw_layers(RasterPath::tiled, 10000), surroundings, "");  // keeps all tiles
  EXPECT_EXIT(draw_layers(RasterPath::tiled, 1 << 25), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace farop::test
