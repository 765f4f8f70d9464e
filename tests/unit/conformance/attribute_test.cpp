// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/attribute.h"

#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

#include "conformance/expectation.h"
#include "conformance/random.h"
#include "conformance/shapes.h"
#include "unit/conformance/long_tests.h"

namespace farop::conformance {
namespace {

using Exact = CGAL::Exact_rational;

Exact to_exact(const Rational& r) {
  const auto wide = [](Wide v) {
    const bool negative = v < 0;
    if (negative) v = -v;
    Exact e = Exact(static_cast<double>(static_cast<std::uint32_t>(v >> 96)));
    for (int shift = 64; shift >= 0; shift -= 32)
      e = e * 4294967296.0 + Exact(static_cast<double>(static_cast<std::uint32_t>(v >> shift)));
    return negative ? Exact(-e) : e;
  };
  return wide(r.numerator) / wide(r.denominator);
}

/// Barycentric, in exact rationals.
Exact barycentric(const TestPolygon& t, Attribute a, int x, int y) {
  const auto area = [](Exact ax, Exact ay, Exact bx, Exact by, Exact cx, Exact cy) {
    return Exact((bx - ax) * (cy - ay) - (by - ay) * (cx - ax));
  };
  const Exact whole = area(t[0].x, t[0].y, t[1].x, t[1].y, t[2].x, t[2].y);
  Exact sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenVertex &b = t[(i + 1) % 3], &c = t[(i + 2) % 3];
    sum += area(x, y, b.x, b.y, c.x, c.y) / whole * Exact(static_cast<double>(value_of(t[i], a)));
  }
  return sum;
}

TEST(Attributes, AreBarycentricOnTriangles) {
  // 2000 by default, 10^6 with FAROP_LONG_TESTS=1.
  const std::uint64_t count = test::repetitions(2000, 1'000'000);
  for (std::uint64_t i = 0; i < count; ++i) {
    Random random("attribute/triangles", i, 1);
    const int size = i % 2 == 0 ? 64 : 4096;
    TestPolygon t;
    for (int k = 0; k < 3; ++k) {
      t.push_back(corner(random.between(0, size - 1), random.between(0, size - 1),
                         random.between(0, (1 << 30) - 1),
                         {static_cast<std::uint8_t>(random.below(256)), 0, 255}));
    }
    if (twice_area(t) == 0) continue;
    const int x = random.between(0, size - 1), y = random.between(0, size - 1);
    for (const Attribute a : k_attributes) {
      const auto plane = plane_through(t, a);
      ASSERT_TRUE(plane);
      ASSERT_EQ(to_exact(plane->at(x, y)), barycentric(t, a, x, y));
    }
    // The scan-line method gives the same wherever it is defined.
    const auto row = scan_line_value(t, Attribute::r, x, y);
    if (row && size == 64) {
      ASSERT_EQ(to_exact(*row), barycentric(t, Attribute::r, x, y));
    }
  }
}

TEST(Attributes, OfBentQuadsHaveNoPlane) {
  TestPolygon quad = rectangle(0, 0, 10, 10);
  EXPECT_TRUE(plane_through(quad, Attribute::z));
  quad[2].z = 1;
  EXPECT_FALSE(plane_through(quad, Attribute::z));
  quad[1].z = quad[2].z = 7;
  EXPECT_TRUE(plane_through(quad, Attribute::z));
}

TEST(Tolerances, AreAsDerived) {
  TestPolygon t = polygon_of({{0, 0}, {30, 0}, {0, 20}});
  t[1].z = 60;  // dz/dx = 2
  const Tolerance tolerance = tolerance_of(t, *plane_through(t, Attribute::z));
  EXPECT_EQ(tolerance.unremarkable, (Rational{65536 + 20 + 30 + 2 + 4, 65536}));
  EXPECT_EQ(tolerance.bound, (Rational{65536 + 16384 + 4, 65536}));
}

TEST(Visibility, IsForcedBeyondOneAndTheDriftOfBoth) {
  const auto scene = [](int back) {
    Drawing d;
    d.polygons = {rectangle(0, 0, 8, 8), polygon_of({{0, 0}, {8, 0}, {8, 8}, {0, 8}})};
    set_depth(d.polygons[0], 100), set_depth(d.polygons[1], back);
    return d;
  };
  const auto winners = [](const Drawing& d) { return Expectation(d, ConsistentRule::lb).admissible(3, 3); };
  EXPECT_EQ(winners(scene(101)), std::vector<std::uint32_t>{0});  // constant depths: one is enough
  EXPECT_EQ(winners(scene(100)).size(), 2u);
  EXPECT_EQ(winners(scene(99)), std::vector<std::uint32_t>{1});
  Drawing slanted = scene(103);
  slanted.polygons[1][1].z = slanted.polygons[1][2].z = 95;  // 103 - x: 100 at x = 3
  EXPECT_EQ(winners(slanted).size(), 2u);
  EXPECT_EQ(Expectation(slanted, ConsistentRule::lb).admissible(1, 3), std::vector<std::uint32_t>{0});
  EXPECT_EQ(Expectation(slanted, ConsistentRule::lb).admissible(2, 3).size(),
            2u);  // 1 in front: it may drift
  EXPECT_EQ(Expectation(slanted, ConsistentRule::lb).admissible(5, 3), std::vector<std::uint32_t>{1});
}

}  // namespace
}  // namespace farop::conformance
