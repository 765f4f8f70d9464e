// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/reference.h"

#include <gtest/gtest.h>

#include "unit/raster/raster_test_support.h"

namespace farop::test {
namespace {

TEST(Reference, CoversTheLectureExample) {
  const Corners lecture = {vertex(0, 1), vertex(2, 8), vertex(4, 6),
                           vertex(7, 8), vertex(9, 4), vertex(6, 1)};
  const std::vector<std::uint8_t> covered = reference::coverage(lecture, 0, 10, 9);
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), 43);
  EXPECT_TRUE(reference::covers(lecture, 0, 4, 6));
  EXPECT_FALSE(reference::covers(lecture, 0, 8, 6));
}

/// Pick's theorem: 2A = 2I + B - 2. Interior samples are those covered whichever way the sample is moved a
/// little; moving it left, right, up or down is the same as reflecting the polygon and using the one rule
/// there is.
TEST(Reference, ObeysPicksTheorem) {
  Random random(61);
  constexpr int k_last = 14;
  int polygons = 0;
  for (int i = 0; i < 4000; ++i) {
    const Corners corners = random_polygon(random, Shape::triangle, 0, k_last, 0, k_last);
    std::int64_t twice_area = 0, boundary = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const ScreenVertex &a = corners[k], &b = corners[(k + 1) % 3];
      twice_area += std::int64_t{a.x} * b.y - std::int64_t{b.x} * a.y;
      boundary += std::gcd(a.x - b.x, a.y - b.y);
    }
    if (twice_area == 0) continue;
    const auto covered = [&](int x, int y, bool flip_x, bool flip_y) {
      Corners flipped = corners;
      for (ScreenVertex& v : flipped) v.x = flip_x ? k_last - v.x : v.x, v.y = flip_y ? k_last - v.y : v.y;
      return reference::covers(flipped, 0, flip_x ? k_last - x : x, flip_y ? k_last - y : y);
    };
    std::int64_t interior = 0;
    for (int y = 0; y <= k_last; ++y) {
      for (int x = 0; x <= k_last; ++x) {
        const bool all = covered(x, y, false, false) && covered(x, y, true, false) &&
                         covered(x, y, false, true) && covered(x, y, true, true);
        interior += all ? 1 : 0;
      }
    }
    ASSERT_EQ(std::abs(twice_area), 2 * interior + boundary - 2);
    ++polygons;
  }
  EXPECT_GT(polygons, 3500);
}

TEST(Reference, GivesExactValuesOfAffineFunctions) {
  const Corners corners = {vertex(0, 0), vertex(7, 0), vertex(0, 5)};
  const auto f = reference::AffineFunction::through(corners, std::vector<std::int64_t>{10, 11, 13});
  ASSERT_TRUE(f);
  const reference::Rational value = f->at(0, 2, 3);  // 10 + 2/7 + 9/5
  EXPECT_TRUE(value.numerator * 35 == value.denominator * (350 + 10 + 63));
  EXPECT_TRUE(value.is_within(12, 1));
  EXPECT_TRUE(value.is_within(13, 1));
  EXPECT_FALSE(value.is_within(14, 1));
  EXPECT_FALSE(value.is_within(11, 1));
}

TEST(Reference, FindsNoAffineFunctionForALineOrABentPolygon) {
  const std::vector<std::int64_t> values = {1, 2, 3};
  EXPECT_FALSE(reference::AffineFunction::through(Corners{vertex(0, 0), vertex(2, 2), vertex(5, 5)}, values));
  EXPECT_FALSE(reference::AffineFunction::through(Corners{vertex(1, 1), vertex(1, 1), vertex(1, 1)}, values));
  const Corners square = {vertex(0, 0), vertex(4, 0), vertex(4, 4), vertex(0, 4)};
  EXPECT_TRUE(reference::AffineFunction::through(square, std::vector<std::int64_t>{0, 4, 8, 4}));
  EXPECT_FALSE(reference::AffineFunction::through(square, std::vector<std::int64_t>{0, 4, 9, 4}));
}

}  // namespace
}  // namespace farop::test
