// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/predicates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "unit/geometry/lattice_polygons.h"

namespace farop {
namespace {

__extension__ using Int128 = __int128;

int sign(Int128 v) {
  return v > 0 ? 1 : v < 0 ? -1 : 0;
}

TEST(Orientation, TellsLeftFromRight) {
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {1, 1}), 1);
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {1, -1}), -1);
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {2, 0}), 0);
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {-1, 0}), 0);
  EXPECT_EQ(orientation({1, 1}, {1, 1}, {5, 3}), 0);
}

TEST(Orientation, IsExactNextToALine) {
  // A point within 256 units in the last place of (0.5, 0.5) against the diagonal through (12, 12) and (24,
  // 24): rounded arithmetic answers at random here. Times 2^53 everything is a whole number.
  const double unit = 0x1p-53;
  for (std::int64_t i = 0; i < 256; ++i) {
    for (std::int64_t j = 0; j < 256; ++j) {
      const V2d p(0.5 + static_cast<double>(i) * unit, 0.5 + static_cast<double>(j) * unit);
      ASSERT_EQ(orientation(p, {12, 12}, {24, 24}), sign(Int128{j} - i)) << i << ' ' << j;
    }
  }
}

TEST(Orientation, AgreesWithIntegersOnLargeLatticePoints) {
  lattice::Random random(1);
  const std::int64_t size = std::int64_t{1} << 52;
  int collinear = 0;
  for (int i = 0; i < 20000; ++i) {
    const lattice::Point a{lattice::below(random, size), lattice::below(random, size)};
    const lattice::Point b{lattice::below(random, size), lattice::below(random, size)};
    lattice::Point c{2 * b.x - a.x, 2 * b.y - a.y};  // collinear, or beside it by a step
    if (i % 2 == 0) c.x += lattice::below(random, 3) - 1;
    const int expected = sign(Int128{b.x - a.x} * (c.y - a.y) - Int128{c.x - a.x} * (b.y - a.y));
    collinear += expected == 0 ? 1 : 0;
    const auto to_double = [](const lattice::Point& p) {
      return V2d(static_cast<double>(p.x), static_cast<double>(p.y));
    };
    ASSERT_EQ(orientation(to_double(a), to_double(b), to_double(c)), expected);
    ASSERT_EQ(orientation(to_double(b), to_double(a), to_double(c)), -expected);
    ASSERT_EQ(orientation(to_double(b), to_double(c), to_double(a)), expected);
  }
  EXPECT_GT(collinear, 10000);
}

TEST(Orientation, IsExactAtTheEndsOfTheNumberRange) {
  constexpr double most = std::numeric_limits<double>::max();
  constexpr double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(orientation({-most, -most}, {most, -most}, {0, most}), 1);
  EXPECT_EQ(orientation({-most, -most}, {0, 0}, {most, most}), 0);
  EXPECT_EQ(orientation({0, 0}, {least, 0}, {0, least}), 1);
  EXPECT_EQ(orientation({0, 0}, {least, least}, {2 * least, 2 * least}), 0);
  EXPECT_EQ(orientation({0, 0}, {most, most}, {least, 0}), -1);
}

TEST(AreaSign, TellsWhichWayARingRuns) {
  const std::vector<V2d> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(area_sign(square), 1);
  EXPECT_EQ(area_sign(std::vector<V2d>(square.rbegin(), square.rend())), -1);
  EXPECT_EQ(area_sign({}), 0);
  EXPECT_EQ(area_sign(std::vector<V2d>{{0, 0}, {1, 0}}), 0);
  EXPECT_EQ(area_sign(std::vector<V2d>{{0, 0}, {1, 1}, {1, 0}, {0, 1}}), 0) << "a bow tie";
}

TEST(AreaSign, AgreesWithIntegers) {
  lattice::Random random(2);
  for (int i = 0; i < 5000; ++i) {
    lattice::Polygon ring(3 + static_cast<std::size_t>(lattice::below(random, 8)));
    for (lattice::Point& p : ring) p = {lattice::below(random, 3), lattice::below(random, 3)};
    const std::int64_t area = lattice::doubled_area(ring);
    std::vector<V2d> points;  // so far away that the area is lost in rounding unless it is computed exactly
    for (const lattice::Point& p : ring) {
      points.emplace_back(0x1p51 + static_cast<double>(p.x), -0x1p51 + static_cast<double>(p.y));
    }
    ASSERT_EQ(area_sign(points), sign(area));
  }
}

TEST(AreaSign, SeesAreasBelowTheRoundingOfTheirSum) {
  // Two large triangles of opposite orientation that differ by one unit in the last place of one corner.
  const double next = std::nextafter(1.0, 2.0);
  EXPECT_EQ(area_sign(std::vector<V2d>{{0, 0}, {0x1p60, 1}, {0x1p60, 0}, {0, 0}, {0x1p60, 0}, {0x1p60, 1}}),
            0);
  EXPECT_EQ(
      area_sign(std::vector<V2d>{{0, 0}, {0x1p60, 1}, {0x1p60, 0}, {0, 0}, {0x1p60, 0}, {0x1p60, next}}), 1);
  EXPECT_EQ(
      area_sign(std::vector<V2d>{{0, 0}, {0x1p60, next}, {0x1p60, 0}, {0, 0}, {0x1p60, 0}, {0x1p60, 1}}), -1);
  constexpr double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(area_sign(std::vector<V2d>{{0, 0}, {least, 0}, {0, least}}), 1);
  constexpr double most = std::numeric_limits<double>::max();
  EXPECT_EQ(area_sign(std::vector<V2d>{{-most, -most}, {most, -most}, {0, most}}), 1);
}

}  // namespace
}  // namespace farop
