// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/line.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "unit/raster/raster_test_support.h"

namespace farop::test {
namespace {

constexpr int k_size = 20;
using PixelSet = std::set<std::pair<std::int64_t, std::int64_t>>;

PixelSet pixels_of(const Framebuffer& picture, int ink) {
  PixelSet set;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (red(picture, x, y) == ink) set.emplace(x, y);
    }
  }
  return set;
}

PixelSet line_pixels(PixelPosition a, PixelPosition b) {
  Framebuffer picture;
  picture.width = k_size, picture.height = k_size;
  picture.rgb.assign(3 * k_size * k_size, 0);
  draw_line(picture, a, b, {255, 255, 255});
  return pixels_of(picture, 255);
}

/// For every step along the longer axis the pixel nearest to the exact line, found by trying all.
PixelSet nearest_pixels(PixelPosition a, PixelPosition b) {
  if (std::pair(a.y, a.x) > std::pair(b.y, b.x)) std::swap(a, b);
  const std::int64_t dx = std::abs(b.x - a.x), dy = b.y - a.y, length = std::max(dx, dy),
                     rise = std::min(dx, dy);
  PixelSet set;
  for (std::int64_t k = 0; k <= length; ++k) {
    std::int64_t best = 0;
    for (std::int64_t m = 0; m <= rise; ++m) {
      if (std::abs(m * length - k * rise) <= std::abs(best * length - k * rise))
        best = m;  // ties: the farther one
    }
    const std::int64_t along_x = dy > dx ? best : k, along_y = dy > dx ? k : best;
    const std::int64_t x = b.x < a.x ? a.x - along_x : a.x + along_x, y = a.y + along_y;
    if (x >= 0 && x < k_size && y >= 0 && y < k_size) set.emplace(x, y);
  }
  return set;
}

TEST(Line, DrawsTheNearestPixelsWhicheverEndComesFirst) {
  Random random(31);
  for (int i = 0; i < 8000; ++i) {
    const int margin = i % 2 == 0 ? 0 : 30;
    const auto any = [&] {
      return PixelPosition{random.between(-margin, k_size - 1 + margin),
                           random.between(-margin, k_size - 1 + margin)};
    };
    const PixelPosition a = any(), b = any();
    const PixelSet drawn = line_pixels(a, b);
    ASSERT_EQ(drawn, nearest_pixels(a, b)) << a.x << ' ' << a.y << " - " << b.x << ' ' << b.y;
    ASSERT_EQ(drawn, line_pixels(b, a));
    if (margin == 0) {
      ASSERT_TRUE(drawn.count({a.x, a.y}) == 1 && drawn.count({b.x, b.y}) == 1);
      ASSERT_EQ(drawn.size(),
                static_cast<std::size_t>(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) + 1));
    }
  }
}

TEST(Line, StepsSidewaysWhereTheLinePassesHalfWay) {
  EXPECT_EQ(line_pixels({0, 0}, {2, 1}), (PixelSet{{0, 0}, {1, 1}, {2, 1}}));
  EXPECT_EQ(line_pixels({5, 0}, {3, 1}), (PixelSet{{5, 0}, {4, 1}, {3, 1}}));
  EXPECT_EQ(line_pixels({3, 3}, {4, 5}), (PixelSet{{3, 3}, {4, 4}, {4, 5}}));
}

TEST(Line, IsExactAndQuickHoweverFarAwayTheEndsAre) {
  constexpr std::int64_t k_far = std::int64_t{1} << 31;
  EXPECT_EQ(line_pixels({-k_far, -k_far}, {k_far, k_far}).size(), std::size_t{k_size});
  EXPECT_EQ(line_pixels({k_far, 7}, {-k_far, 7}).size(), std::size_t{k_size});
  EXPECT_EQ(line_pixels({-k_far, 10 - k_far / 2}, {k_far, 10 + k_far / 2}).count({10, 15}), 1u);
  EXPECT_TRUE(line_pixels({-k_far, k_far}, {k_far, k_far}).empty());
}

Drawing one_polygon(const Corners& corners) {
  Drawing drawing;
  drawing.add(corners);
  return drawing;
}

InternalRasterizerOptions lines_on(Rgb background) {
  InternalRasterizerOptions options;
  options.mode = DrawMode::line;
  options.background = background;
  return options;
}

TEST(LineMode, DrawsEveryEdgeWithoutDepthTest) {
  Drawing drawing = one_polygon(rectangle(2, 2, 12, 12, 0, 9, 9, 9));
  drawing.add(rectangle(4, 4, 18, 8, 500, 9, 9, 9));
  const Framebuffer picture = draw(make_frame(k_size, k_size), drawing, lines_on({}));
  PixelSet expected;
  for (const auto& [a, b] : {std::pair<PixelPosition, PixelPosition>{{2, 2}, {12, 2}},
                             {{12, 2}, {12, 12}},
                             {{12, 12}, {2, 12}},
                             {{2, 12}, {2, 2}},
                             {{4, 4}, {18, 4}},
                             {{18, 4}, {18, 8}},
                             {{18, 8}, {4, 8}},
                             {{4, 8}, {4, 4}}}) {
    expected.merge(line_pixels(a, b));
  }
  EXPECT_EQ(pixels_of(picture, 255), expected);
  EXPECT_EQ(pixels_of(picture, 0).size(), k_size * k_size - expected.size());
  EXPECT_EQ(*std::min_element(picture.depth.begin(), picture.depth.end()), 65536);
}

TEST(LineMode, IsWhiteOrBlackByTheBackgroundsLuminance) {
  const Drawing dot = one_polygon({vertex(3, 3), vertex(3, 3), vertex(3, 3)});
  const auto ink = [&](Rgb background) {
    return red(draw(make_frame(k_size, k_size), dot, lines_on(background)), 3, 3);
  };
  EXPECT_EQ(ink({0.078, 0.361, 0.753}), 255);
  EXPECT_EQ(ink({1, 0.3, 1}), 255);  // 0.4993
  EXPECT_EQ(ink({1, 0.302, 1}), 0);  // 0.5008
  EXPECT_EQ(ink({9, -9, 9}), 255);   // limited first: 0.2848
}

TEST(LineMode, IgnoresTheDegreeOfSuperSampling) {
  const Drawing drawing = one_polygon({vertex(1, 2), vertex(17, 5), vertex(9, 18)});
  InternalRasterizerOptions options = lines_on({});
  const Framebuffer once = draw(make_frame(k_size, k_size), drawing, options);
  options.samples = 4;
  const Framebuffer four = draw(make_frame(k_size, k_size), drawing, options);
  EXPECT_EQ(four.width, k_size);
  EXPECT_EQ(four.rgb, once.rgb);
}

TEST(LineMode, RoundsSubPixelsToWholeOnesFirst) {
  const Framebuffer exact = draw(make_frame(k_size, k_size),
                                 one_polygon({vertex(1, 2), vertex(17, 5), vertex(9, 18)}), lines_on({}));
  const Framebuffer fine = draw(
      make_frame(k_size, k_size, 4),
      one_polygon({vertex(16 - 8, 32 + 7), vertex(17 * 16 + 7, 5 * 16 - 8), vertex(9 * 16 - 1, 18 * 16 + 1)}),
      lines_on({}));
  EXPECT_EQ(fine.rgb, exact.rgb);
}

TEST(LineMode, KeepsTheOuterEndsOfAHalfPixelBorderInThePicture) {
  ScreenFrame frame = make_frame(k_size, k_size, 8);
  frame.half_pixel_border = true;
  const int low = -128, high = k_size * 256 - 128;
  const Framebuffer picture =
      draw(frame, one_polygon({vertex(low, low), vertex(high, low), vertex(high, high), vertex(low, high)}),
           lines_on({}));
  EXPECT_EQ(pixels_of(picture, 255).size(), std::size_t{4 * (k_size - 1)});
  EXPECT_EQ(red(picture, k_size - 1, k_size - 1), 255);
}

TEST(LineMode, SurvivesAnyCoordinates) {
  Random random(32);
  constexpr std::int64_t k_low = std::numeric_limits<std::int32_t>::min();
  constexpr std::int64_t k_high = std::numeric_limits<std::int32_t>::max();
  for (int i = 0; i < 500; ++i) {
    const Corners corners = random_polygon(random, k_shapes[i % 5], k_low, k_high, k_low, k_high);
    EXPECT_EQ(draw(make_frame(k_size, k_size, i % 9), one_polygon(corners), lines_on({})).width, k_size);
  }
}

}  // namespace
}  // namespace farop::test
