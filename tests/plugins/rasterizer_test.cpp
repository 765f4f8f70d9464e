// SPDX-License-Identifier: GPL-3.0-or-later
// What every rasterizer must get right, with nothing but triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "plugins/plugin_cases.h"
#include "plugins/rasterizers.h"

namespace farop::test {
namespace {

class Rasterizer : public testing::TestWithParam<TestedRasterizer> {
 protected:
  PluginPicture draw(const PluginFrame& frame, const std::vector<Corners>& triangles) {
    std::vector<PluginPolygon> polygons;
    for (const Corners& corners : triangles) polygons.push_back(plugin_polygon(corners));
    return driver.draw(frame, polygons);
  }
  void expect_reference_coverage(const PluginFrame& frame, const Corners& corners) {
    const auto expected = reference::coverage(corners, frame.subpixel_bits, frame.width, frame.height);
    ASSERT_EQ(drawn_coverage(driver, frame, corners), expected) << text_of(corners);
  }
  static std::string text_of(const Corners& corners) {
    std::string text;
    for (const ScreenVertex& v : corners) {
      text += "(" + std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z) + ")";
    }
    return text;
  }
  static std::vector<Corners> halves(const Corners& quad) {
    return {{quad[0], quad[1], quad[2]}, {quad[0], quad[2], quad[3]}};
  }

  PluginDriver driver{GetParam().library};
};

INSTANTIATE_TEST_SUITE_P(, Rasterizer, testing::ValuesIn(all_rasterizers()),
                         rasterizer_name<testing::TestParamInfo<TestedRasterizer>>);

// ---- frames
// -----------------------------------------------------------------------------------------------------

TEST_P(Rasterizer, KeepsTheBackgroundOfAnEmptyFrame) {
  PluginFrame frame;
  frame.background = {10, 20, 30};
  const PluginPicture picture = draw(frame, {});
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) ASSERT_EQ(picture.at(x, y), frame.background);
  }
}

TEST_P(Rasterizer, DrawsAQuadrangleOf768PixelsInItsColour) {
  PluginFrame frame;
  frame.background = {1, 2, 3};
  const PluginPicture picture = draw(frame, halves(rectangle(16, 16, 48, 40, 100, 96, 64, 32)));
  int count = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool inside = x >= 16 && x < 48 && y >= 16 && y < 40;
      count += inside ? 1 : 0;
      ASSERT_EQ(picture.at(x, y), inside ? (std::array<std::uint8_t, 3>{96, 64, 32}) : frame.background)
          << x << " " << y;
    }
  }
  EXPECT_EQ(count, 768);
}

TEST_P(Rasterizer, DrawsInFramesOfEverySizeAndAnyPadding) {
  Random random(1);
  constexpr std::array<int, 2> sizes[] = {{1, 1},   {1, 64},  {64, 1},   {2, 2},    {3, 5},
                                          {61, 67}, {17, 31}, {4096, 8}, {8, 4096}, {2, 3}};
  for (const auto& [width, height] : sizes) {
    for (const int padding : {0, 1, 2, 5, 64}) {
      PluginFrame frame;
      frame.width = width, frame.height = height, frame.padding = padding;
      // The whole window first: last column and top row belong to nobody.
      expect_reference_coverage(frame, {vertex(0, 0), vertex(width - 1, 0), vertex(width - 1, height - 1)});
      expect_reference_coverage(frame, {vertex(0, 0), vertex(width - 1, height - 1), vertex(0, height - 1)});
      for (int i = 0; i < 5; ++i) {
        expect_reference_coverage(frame,
                                  random_polygon(random, Shape::triangle, 0, width - 1, 0, height - 1));
      }
    }
  }
}

TEST_P(Rasterizer, DrawsASecondFrameLikeAFirst) {
  Random random(2);
  std::vector<Corners> small, large;
  for (int i = 0; i < 20; ++i) {
    for (const auto& [list, x, y] : {std::tuple{&small, 16, 30}, std::tuple{&large, 99, 79}}) {
      Corners corners = random_polygon(random, Shape::triangle, 0, x, 0, y);
      for (const Attribute attribute : k_attributes) scatter(random, corners, attribute, 255);
      list->push_back(corners);
    }
  }
  PluginFrame small_frame, large_frame;
  small_frame.width = 17, small_frame.height = 31;
  large_frame.width = 100, large_frame.height = 80, large_frame.z_far = 255;
  const PluginPicture first = draw(small_frame, small), second = draw(large_frame, large);
  EXPECT_EQ(draw(small_frame, small), first);
  EXPECT_EQ(draw(large_frame, large), second);
  PluginDriver other(GetParam().library);  // and beside a second instance
  std::vector<PluginPolygon> polygons;
  for (const Corners& corners : large) polygons.push_back(plugin_polygon(corners));
  EXPECT_EQ(other.draw(large_frame, polygons), second);
  EXPECT_EQ(draw(small_frame, small), first);
}

TEST_P(Rasterizer, DrawsSubpixelsExactlyOrSaysWhatToDo) {
  Random random(3);
  PluginFrame frame;
  frame.subpixel_bits = 4;
  const Corners corners = {vertex(0, 0), vertex(1008, 37), vertex(400, 900)};
  try {
    driver.draw(frame, std::vector{plugin_polygon(corners)});
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("begin_frame returned -2"), std::string::npos) << error.what();
    EXPECT_NE(driver.last_log.find("--subpixel-bits"), std::string::npos) << driver.last_log;
    EXPECT_EQ(driver.logs.size(), 1u);
    return;
  }
  expect_reference_coverage(frame, corners);
  for (int i = 0; i < 200; ++i) {
    expect_reference_coverage(frame, random_polygon(random, Shape::triangle, 0, 63 * 16, 0, 63 * 16));
  }
}

TEST_P(Rasterizer, DrawsAgainAfterARefusedFrame) {
  PluginFrame odd, plain;
  odd.subpixel_bits = 8;
  const std::vector<Corners> scene = halves(rectangle(3, 4, 20, 30, 5, 9, 8, 7));
  const PluginPicture before = draw(plain, scene);
  try {
    draw(odd, {});
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(draw(plain, scene), before);
}

// ---- coverage
// ---------------------------------------------------------------------------------------------------

TEST_P(Rasterizer, CoversAllTrianglesOfAFourByFourLattice) {
  PluginFrame frame;
  frame.width = frame.height = 5;
  for (int a = 0; a < 16; ++a) {
    for (int b = 0; b < 16; ++b) {
      for (int c = 0; c < 16; ++c) {  // in every order, and those without area
        expect_reference_coverage(frame, {vertex(a % 4, a / 4), vertex(b % 4, b / 4), vertex(c % 4, c / 4)});
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST_P(Rasterizer, CoversRandomTriangles) {
  Random random(4);
  for (int i = 0; i < 6000; ++i) {
    PluginFrame frame;
    frame.width = random.integer(1, 40), frame.height = random.integer(1, 40);
    expect_reference_coverage(
        frame, random_polygon(random, Shape::triangle, 0, frame.width - 1, 0, frame.height - 1));
    if (HasFatalFailure()) return;
  }
}

TEST_P(Rasterizer, CoversLongThinTriangles) {
  Random random(5);
  PluginFrame frame;
  frame.width = 1500, frame.height = 40;
  for (int i = 0; i < 60; ++i) {
    if (i == 30) std::swap(frame.width, frame.height);
    expect_reference_coverage(
        frame, random_polygon(random, Shape::triangle, 0, frame.width - 1, 0, frame.height - 1));
    if (HasFatalFailure()) return;
  }
}

TEST_P(Rasterizer, DrawsNothingWithoutArea) {
  PluginFrame frame;
  for (const Corners& corners : {Corners{vertex(5, 9), vertex(5, 9), vertex(5, 9)},
                                 Corners{vertex(2, 9), vertex(30, 9), vertex(11, 9)},
                                 Corners{vertex(7, 1), vertex(7, 40), vertex(7, 20)},
                                 Corners{vertex(0, 0), vertex(60, 30), vertex(20, 10)},
                                 Corners{vertex(60, 1), vertex(1, 60), vertex(60, 1)}}) {
    EXPECT_EQ(drawn_coverage(driver, frame, corners), std::vector<std::uint8_t>(64 * 64)) << text_of(corners);
  }
}

/// Adds up what each polygon covers on its own: expected once inside of (x0, y0)-(x1, y1) and nowhere else.
void expect_tiling(PluginDriver& driver, const PluginFrame& frame, const std::vector<Corners>& tiles,
                   const Corners& whole) {
  std::vector<int> times(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  for (const Corners& tile : tiles) {
    const auto covered = drawn_coverage(driver, frame, tile);
    for (std::size_t i = 0; i < times.size(); ++i) times[i] += covered[i];
  }
  const auto expected = reference::coverage(whole, 0, frame.width, frame.height);
  ASSERT_TRUE(std::equal(times.begin(), times.end(), expected.begin()));
}

TEST_P(Rasterizer, TilesFansOnce) {
  PluginFrame frame;
  frame.width = frame.height = 33;
  const Corners hexagon = {vertex(16, 0),  vertex(32, 8), vertex(32, 24),
                           vertex(16, 32), vertex(0, 24), vertex(0, 8)};
  const Corners square = {vertex(0, 0),   vertex(11, 0), vertex(32, 0), vertex(32, 13), vertex(32, 32),
                          vertex(19, 32), vertex(7, 32), vertex(0, 32), vertex(0, 21)};
  for (const Corners& ring : {hexagon, square}) {
    for (const ScreenVertex& centre : {vertex(16, 16), vertex(15, 9), vertex(21, 20)}) {
      std::vector<Corners> tiles;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        tiles.push_back({centre, ring[i], ring[(i + 1) % ring.size()]});
      }
      expect_tiling(driver, frame, tiles, ring);
    }
  }
}

TEST_P(Rasterizer, TilesShearedGridsOnce) {
  PluginFrame frame;
  frame.width = 64, frame.height = 30;
  for (int shear = 0; shear < 8; ++shear) {
    for (const bool other_diagonal : {false, true}) {
      const auto at = [&](int column, int row) { return vertex(5 * column + shear * row, 7 * row); };
      std::vector<Corners> tiles;
      for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 6; ++column) {
          Corners quad = {at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)};
          if (other_diagonal) std::rotate(quad.begin(), quad.begin() + 1, quad.end());
          for (const Corners& half : halves(quad)) tiles.push_back(half);
        }
      }
      expect_tiling(driver, frame, tiles, {at(0, 0), at(6, 0), at(6, 4), at(0, 4)});
    }
  }
}

// ---- depth
// ------------------------------------------------------------------------------------------------------

TEST_P(Rasterizer, ShowsTheNearerWhicheverComesFirst) {
  const auto far = halves(rectangle(24, 24, 56, 56, 200, 0, 200, 0));
  auto scene = halves(rectangle(8, 8, 40, 40, 100, 200, 0, 0));
  scene.insert(scene.end(), far.begin(), far.end());
  for (int turn = 0; turn < 2; ++turn) {
    const PluginPicture picture = draw({}, scene);
    EXPECT_EQ(picture.at(30, 30)[0], 200) << turn;
    EXPECT_EQ(picture.at(39, 39)[0], 200);
    EXPECT_EQ(picture.at(40, 40)[1], 200);
    EXPECT_EQ(picture.at(55, 30)[1], 200);
    std::rotate(scene.begin(), scene.begin() + 2, scene.end());
  }
}

TEST_P(Rasterizer, KeepsTheFirstOfEqualDepths) {
  for (const std::int32_t z : {0, 100, 65535}) {
    auto scene = halves(rectangle(8, 8, 40, 40, z, 50, 0, 0));
    for (const Corners& half : halves(rectangle(10, 4, 30, 50, z, 90, 0, 0))) scene.push_back(half);
    for (const Corners& half : halves(rectangle(0, 0, 63, 63, z, 130, 0, 0))) scene.push_back(half);
    const PluginPicture picture = draw({}, scene);
    for (int y = 0; y < 63; ++y) {
      for (int x = 0; x < 63; ++x) {
        const bool first = x >= 8 && x < 40 && y >= 8 && y < 40,
                   second = x >= 10 && x < 30 && y >= 4 && y < 50;
        ASSERT_EQ(picture.at(x, y)[0], first ? 50 : second ? 90 : 130) << x << " " << y << " z " << z;
      }
    }
  }
}

/// A slope and a decal on it, cut into other triangles: equal at every sample, so the first one stays
/// everywhere.
TEST_P(Rasterizer, KeepsTheFirstOfTwoInOneSlopingPlane) {
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    Corners both = random_polygon(random, Shape::tangle, 0, 63, 0, 63);
    both.resize(3);
    for (int k = 0; k < 3; ++k) both.push_back(vertex(random.integer(0, 63), random.integer(0, 63)));
    make_planar(random, both, Attribute::z, 65535);
    Corners first(both.begin(), both.begin() + 3), second(both.begin() + 3, both.end());
    paint(first, 50, 50, 50), paint(second, 90, 90, 90);
    const PluginPicture picture = draw({}, {first, second});
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const int expected = reference::covers(first, 0, x, y)    ? 50
                             : reference::covers(second, 0, x, y) ? 90
                                                                  : 0;
        ASSERT_EQ(picture.at(x, y)[0], expected) << text_of(first) << " " << text_of(second);
      }
    }
  }
}

TEST_P(Rasterizer, ShowsTheFarPlane) {
  for (const std::int32_t z_far : {1, 511, 65535, (1 << 24) - 1, (1 << 30) - 1}) {
    PluginFrame frame;
    frame.z_far = z_far;
    const PluginPicture picture = draw(frame, halves(rectangle(8, 8, 40, 40, z_far, 50, 60, 70)));
    EXPECT_EQ(picture.at(8, 8)[0], 50) << z_far;
    EXPECT_EQ(picture.at(39, 39)[2], 70) << z_far;
  }
}

TEST_P(Rasterizer, ShowsWherePlanesMeet) {
  Corners rising = rectangle(8, 8, 56, 56, 0, 50, 0, 0), falling = rectangle(8, 8, 56, 56, 0, 90, 0, 0);
  for (ScreenVertex& v : rising) v.z = 36 + 8 * v.x;
  for (ScreenVertex& v : falling) v.z = 540 - 8 * v.x;
  std::vector<Corners> scene = halves(rising);
  for (const Corners& half : halves(falling)) scene.push_back(half);
  for (int turn = 0; turn < 2; ++turn) {
    const PluginPicture picture = draw({}, scene);
    for (int y = 8; y < 56; ++y) {
      for (int x = 8; x < 56; ++x) ASSERT_EQ(picture.at(x, y)[0], x < 31.5 ? 50 : 90) << x << " " << y;
    }
    std::rotate(scene.begin(), scene.begin() + 2, scene.end());
  }
}

/// Within one unit of the exact depth wherever the triangle is.
TEST_P(Rasterizer, MeasuresTheDepthOfRandomTriangles) {
  Random random(7);
  struct Case {
    int size;
    std::int32_t z_far;
    int count;
  };
  for (const Case& c : {Case{12, 1, 20}, Case{24, 511, 60}, Case{24, 65535, 60}, Case{24, (1 << 24) - 1, 40},
                        Case{24, (1 << 30) - 1, 40}}) {
    for (int i = 0; i < c.count; ++i) {
      PluginFrame frame;
      frame.width = frame.height = c.size;
      frame.z_far = c.z_far;
      Corners corners = random_polygon(random, Shape::triangle, 0, c.size - 1, 0, c.size - 1);
      scatter(random, corners, Attribute::z, c.z_far);
      const auto exact = exact_attribute(corners, Attribute::z);
      if (!exact) continue;
      std::vector<Sample> samples;
      for (int y = 0; y < c.size; ++y) {
        for (int x = 0; x < c.size; ++x) {
          if (reference::covers(corners, 0, x, y)) samples.push_back({x, y});
        }
      }
      const auto shows = measured_depth(driver, frame, {plugin_polygon(corners)}, samples);
      for (std::size_t k = 0; k < samples.size(); ++k) {
        // The first drawn wins ties, so the farthest probe that shows is one nearer than what was stored.
        ASSERT_TRUE(exact->at(0, samples[k].x, samples[k].y).is_within(shows[k] + 1, 1))
            << text_of(corners) << " at " << samples[k].x << " " << samples[k].y << ": " << shows[k] + 1;
      }
    }
  }
}

/// Wide, so that products of differences need all their bits, and every 997th sample is enough.
TEST_P(Rasterizer, MeasuresTheDepthOfWideTriangles) {
  Random random(8);
  for (const std::int32_t z_far : {65535, (1 << 24) - 1, (1 << 30) - 1}) {
    for (int i = 0; i < 4; ++i) {
      PluginFrame frame;
      frame.width = i < 2 ? 32767 : 9, frame.height = i < 2 ? 9 : 32767;
      frame.z_far = z_far;
      Corners corners = {vertex(0, random.integer(0, frame.height / 2)), vertex(frame.width - 1, 0),
                         vertex(random.integer(frame.width / 2, frame.width - 1), frame.height - 1)};
      for (ScreenVertex& v : corners) v.z = random.integer(0, 1) == 0 ? 0 : z_far;
      if (i % 2 == 0) scatter(random, corners, Attribute::z, z_far);
      const auto exact = exact_attribute(corners, Attribute::z);
      ASSERT_TRUE(exact);
      std::vector<Sample> samples;
      for (int k = 0; k < frame.width * frame.height; k += 997) {
        const Sample sample = {k % frame.width, k / frame.width};
        if (reference::covers(corners, 0, sample.x, sample.y)) samples.push_back(sample);
      }
      ASSERT_FALSE(samples.empty());
      const auto shows = measured_depth(driver, frame, {plugin_polygon(corners)}, samples);
      for (std::size_t k = 0; k < samples.size(); ++k) {
        ASSERT_TRUE(exact->at(0, samples[k].x, samples[k].y).is_within(shows[k] + 1, 1))
            << text_of(corners) << " at " << samples[k].x << " " << samples[k].y << ": " << shows[k] + 1;
      }
    }
  }
}

TEST_P(Rasterizer, LeavesNoDepthWhereItWasHidden) {
  // near, far behind it, then one in between: only the near one may hide it.
  std::vector<Corners> scene = halves(rectangle(8, 8, 40, 40, 100, 50, 0, 0));
  for (const int z : {300, 200}) {
    for (const Corners& half : halves(rectangle(4, 4, 60, 60, z, z / 2, 0, 0))) scene.push_back(half);
  }
  for (const Corners& half : halves(rectangle(20, 20, 30, 30, 99, 70, 0, 0))) scene.push_back(half);
  const PluginPicture picture = draw({}, scene);
  EXPECT_EQ(picture.at(10, 10)[0], 50);
  EXPECT_EQ(picture.at(50, 50)[0], 100);
  EXPECT_EQ(picture.at(25, 25)[0], 70);
}

// ---- colour
// -----------------------------------------------------------------------------------------------------

TEST_P(Rasterizer, InterpolatesColourWithinOneUnit) {
  Random random(9);
  for (int i = 0; i < 600; ++i) {
    PluginFrame frame;
    frame.width = i % 3 == 0 ? 300 : 40, frame.height = i % 5 == 0 ? 200 : 30;
    Corners corners = random_polygon(random, Shape::triangle, 0, frame.width - 1, 0, frame.height - 1);
    for (const Attribute attribute : k_attributes) scatter(random, corners, attribute, 255);
    if (i % 7 == 0) {
      for (ScreenVertex& v : corners) v.r = v.r < 128 ? 0 : 255, v.g = v.g < 128 ? 0 : 255;
    }
    const PluginPicture picture = draw(frame, {corners});
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        if (!reference::covers(corners, 0, x, y)) continue;
        for (const Attribute attribute : {Attribute::r, Attribute::g, Attribute::b}) {
          const int got = picture.at(x, y)[static_cast<std::size_t>(attribute) - 1];
          ASSERT_TRUE(exact_attribute(corners, attribute)->at(0, x, y).is_within(got, 1))
              << text_of(corners) << " at " << x << " " << y << ": " << got;
        }
      }
    }
  }
}

TEST_P(Rasterizer, HitsWholeColoursExactly) {
  Random random(10);
  for (int i = 0; i < 200; ++i) {
    Corners corners = random_polygon(random, Shape::triangle, 0, 63, 0, 63);
    for (ScreenVertex& v : corners) {
      v.r = static_cast<std::uint16_t>(v.x), v.g = static_cast<std::uint16_t>(v.y),
      v.b = static_cast<std::uint16_t>(127 - v.x);
    }
    const PluginPicture picture = draw({}, {corners});
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        if (!reference::covers(corners, 0, x, y)) continue;
        const std::array<std::uint8_t, 3> expected = {
            static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(127 - x)};
        ASSERT_EQ(picture.at(x, y), expected) << text_of(corners) << " at " << x << " " << y;
      }
    }
  }
}

}  // namespace
}  // namespace farop::test
