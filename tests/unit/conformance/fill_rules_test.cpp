// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/fill_rules.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "conformance/shapes.h"

namespace farop::conformance {
namespace {

std::vector<TestPolygon> triangles_of_4x4() {
  std::vector<TestPolygon> triangles;
  const auto point = [](int i) { return Point{i % 4 + 4, i / 4 + 4}; };
  for (int a = 0; a < 16; ++a) {
    for (int b = a + 1; b < 16; ++b) {
      for (int c = b + 1; c < 16; ++c) {
        if (turn(point(a), point(b), point(c)) != 0)
          triangles.push_back(polygon_of({point(a), point(b), point(c)}));
      }
    }
  }
  return triangles;
}

TEST(FillRules, AreAllToldApartByTheTrianglesOfA4x4Lattice) {
  const auto triangles = triangles_of_4x4();
  ASSERT_EQ(triangles.size(), 516u);
  for (int a = 0; a < k_fill_rules; ++a) {
    for (int b = a + 1; b < k_fill_rules; ++b) {
      const auto differing = std::ranges::count_if(triangles, [&](const TestPolygon& t) {
        const Window w{0, 0, 12, 12};
        return rule_coverage(t, FillRule{static_cast<std::uint8_t>(a)}, w).at !=
               rule_coverage(t, FillRule{static_cast<std::uint8_t>(b)}, w).at;
      });
      EXPECT_GE(differing, 20) << rule_name(FillRule{static_cast<std::uint8_t>(a)}) << " "
                               << rule_name(FillRule{static_cast<std::uint8_t>(b)});
    }
  }
}

TEST(FillRules, TruncIsRbOnePixelFurtherLeft) {
  for (const TestPolygon& t : triangles_of_4x4()) {
    const Bitmap trunc = rule_coverage(t, FillRule::trunc, {0, 0, 12, 12});
    const Bitmap rb = rule_coverage(t, FillRule::rb, {1, 0, 13, 12});
    EXPECT_EQ(trunc.at, rb.at);
  }
}

TEST(FillRules, ClosedIsOpenWithItsBoundary) {
  for (const TestPolygon& t : triangles_of_4x4()) {
    const Window w{0, 0, 12, 12};
    Bitmap open = rule_coverage(t, FillRule::open, w);
    mark_boundary(t, open, 1);
    EXPECT_EQ(open.at, rule_coverage(t, FillRule::closed, w).at);
  }
}

TEST(Slips, ChangeSomethingAndAreNoFillRule) {
  std::vector<TestPolygon> polygons = triangles_of_4x4();
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random("slips", i, 1);
    polygons.push_back(moved(polygon_of(random_simple_polygon(random, random.between(4, 9), 6, 6)), 3, 3));
    polygons.push_back(polygons.back());
    polygons.back().insert(polygons.back().begin() + 2, polygons.back()[1]);
  }
  const Window w{0, 0, 12, 12};
  for (int s = 0; s < k_slips; ++s) {
    const Slip slip{static_cast<std::uint8_t>(s)};
    for (int r = 0; r < k_fill_rules; ++r) {
      EXPECT_TRUE(std::ranges::any_of(polygons,
                                      [&](const TestPolygon& p) {
                                        return slip_coverage(p, slip, false, w).at !=
                                               rule_coverage(p, FillRule{static_cast<std::uint8_t>(r)}, w).at;
                                      }))
          << slip_facts(slip).sentence << " " << rule_name(FillRule{static_cast<std::uint8_t>(r)});
    }
  }
}

TEST(Slips, DoWhatTheirNamesSay) {
  const TestPolygon v_shape = polygon_of({{0, 8}, {4, 0}, {8, 8}, {4, 4}});
  const Window w{0, 0, 12, 12};
  const auto row = [&](Slip slip, int y) {
    const Bitmap b = slip_coverage(v_shape, slip, false, w);
    std::string text;
    for (int x = 0; x < 12; ++x) text += b.get(x, y) != 0 ? '#' : '.';
    return text;
  };
  EXPECT_EQ(row(Slip::convex_hull, 6), ".######.....");
  EXPECT_EQ(row(Slip::outermost_crossings, 6), ".######.....");
  EXPECT_EQ(row(Slip::thin_dropped, 6), ".#....#.....");
  EXPECT_EQ(row(Slip::last_row_dropped, 7), "............");
  EXPECT_EQ(row(Slip::counter_clockwise_lost, 6), "............");
  EXPECT_EQ(row(Slip::clockwise_lost, 6), ".#....#.....");
}

}  // namespace
}  // namespace farop::conformance
