// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle against CGAL's exact predicates, and against laws that need no second implementation.
#include "conformance/coverage.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

#include "conformance/random.h"
#include "conformance/shapes.h"
#include "unit/conformance/long_tests.h"

namespace farop::conformance {
namespace {

using test::first_failure;
using test::repetitions;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
constexpr Resolution k_frame{64, 64, 512, 256};

/// How each rule moves the sample: far and a little, in units that a double holds exactly beside 2^10.
struct Move {
  double x, y;
};
constexpr double k_far = 0x1p-20, k_near = 0x1p-40;
constexpr std::array<Move, 8> k_moves = {{{k_far, k_near},
                                          {k_far, -k_near},
                                          {-k_far, k_near},
                                          {-k_far, -k_near},
                                          {k_near, k_far},
                                          {k_near, -k_far},
                                          {-k_near, k_far},
                                          {-k_near, -k_far}}};

/// Mask of a sample by CGAL: where does the moved sample lie?
std::uint8_t cgal_mask(const std::vector<Kernel::Point_2>& ring, int x, int y) {
  std::uint8_t mask = 0;
  for (std::size_t i = 0; i < k_moves.size(); ++i) {
    const Kernel::Point_2 p(x + k_moves[i].x, y + k_moves[i].y);
    if (CGAL::bounded_side_2(ring.begin(), ring.end(), p, Kernel()) == CGAL::ON_BOUNDED_SIDE)
      mask |= static_cast<std::uint8_t>(1u << i);
  }
  return mask;
}

Points corners_of(const TestPolygon& polygon) {
  Points points;
  for (const ScreenVertex& v : polygon) points.push_back({v.x, v.y});
  return points;
}

std::vector<Kernel::Point_2> to_cgal(const TestPolygon& polygon) {
  std::vector<Kernel::Point_2> ring;
  for (const ScreenVertex& v : polygon) ring.emplace_back(v.x, v.y);
  return ring;
}

/// Samples beside corners and lattice points of edges, and random ones, `samples` of each. Corners are below
/// 1024 in units of 2^-bits of a sample. Returns what differs.
std::string difference_from_cgal(const TestPolygon& polygon, Random& random, int samples, int bits) {
  const auto ring = to_cgal(polygon);
  const auto [left, right] = std::ranges::minmax(polygon, {}, &ScreenVertex::x);
  const auto [low, high] = std::ranges::minmax(polygon, {}, &ScreenVertex::y);
  const Window whole{left.x >> bits, low.y >> bits, (right.x >> bits) + 1, (high.y >> bits) + 1};
  // Of large polygons only what is looked at: the rest costs most of the time.
  const bool small = whole.samples() <= 64 * 64;
  const Bitmap masks = small ? coverage_masks(polygon, whole, bits) : Bitmap();
  const auto compare = [&](int x, int y) -> std::string {
    const Window around{x - 1, y - 1, x + 2, y + 2};
    const std::uint8_t mine = small ? masks.get(x, y) : coverage_masks(polygon, around, bits).get(x, y);
    const std::uint8_t theirs = cgal_mask(ring, x << bits, y << bits);
    if (mine == theirs) return {};
    return fmt::format("sample {} {}, {} sub-pixel bits: {:#x}, by CGAL {:#x}\n{}", x, y, bits, mine, theirs,
                       flat_text({{1024, 1024, 512, 256}, {polygon}}));
  };
  for (int n = 0; n < samples; ++n) {
    const ScreenVertex& a = polygon[random.below(polygon.size())];
    const ScreenVertex& b = polygon[random.below(polygon.size())];
    const int steps = std::gcd(b.x - a.x, b.y - a.y);
    const int k = steps == 0 ? 0 : random.between(0, steps);
    const int dx = steps == 0 ? 0 : (b.x - a.x) / steps, dy = steps == 0 ? 0 : (b.y - a.y) / steps;
    std::string wrong = compare(((a.x + k * dx) >> bits) + random.between(-1, 1), (a.y + k * dy) >> bits);
    if (wrong.empty())
      wrong = compare(random.between(whole.x0, whole.x1 - 1), random.between(whole.y0, whole.y1 - 1));
    if (!wrong.empty()) return wrong;
  }
  return {};
}

/// Uniform; long and thin; through many lattice points; with an axis-parallel edge.
TestPolygon random_triangle(Random& random, std::uint64_t kind, int size) {
  const auto any = [&] { return Point{random.between(0, size - 1), random.between(0, size - 1)}; };
  Points p = {any(), any(), any()};
  const auto inside = [size](int v) { return std::clamp(v, 0, size - 1); };
  if (kind % 4 == 1) p[2] = {inside(p[1].x + random.between(-2, 2)), inside(p[1].y + random.between(-2, 2))};
  if (kind % 4 == 2) {
    const int k = random.between(2, 8);
    p[1] = {inside(p[0].x / k * k), inside(p[0].y / k * k)};
    p[2] = {inside(p[2].x / k * k), inside(p[2].y / k * k)};
  }
  if (kind % 4 == 3) (random.below(2) == 0 ? p[1].x = p[0].x : p[1].y = p[0].y);
  return polygon_of(p);
}

TEST(Coverage, AgreesWithCgalOnTriangles) {
  // 20,000 by default, 10^7 with FAROP_LONG_TESTS=1.
  EXPECT_EQ(first_failure(repetitions(20'000, 10'000'000),
                          [](std::uint64_t i) -> std::string {
                            Random random("coverage/triangles", i, 1);
                            const TestPolygon triangle = random_triangle(random, i, i % 2 == 0 ? 64 : 1024);
                            if (twice_area(triangle) == 0) return {};
                            return difference_from_cgal(triangle, random, 3, 0);
                          }),
            "");
}

TEST(Coverage, AgreesWithCgalOnConcavePolygons) {
  // 1000 by default, 10^5 with FAROP_LONG_TESTS=1.
  EXPECT_EQ(first_failure(repetitions(1000, 100'000),
                          [](std::uint64_t i) {
                            Random random("coverage/concave", i, 1);
                            const int size = i % 2 == 0 ? 12 : 64;
                            const Points ring =
                                random_simple_polygon(random, random.between(4, 20), size, size);
                            return difference_from_cgal(polygon_of(ring), random, 12, 0);
                          }),
            "");
}

TEST(Coverage, AgreesWithCgalBetweenThePixels) {
  // 10,000 by default, 10^6 with FAROP_LONG_TESTS=1.
  EXPECT_EQ(first_failure(repetitions(10'000, 1'000'000),
                          [](std::uint64_t i) -> std::string {
                            Random random("coverage/sub-pixel", i, 1);
                            const int bits = random.between(1, 8);
                            const Points ring =
                                i % 8 == 0 ? random_simple_polygon(random, 9, 1024, 1024) : Points();
                            TestPolygon polygon =
                                ring.empty() ? random_triangle(random, i, 1024) : polygon_of(ring);
                            // Corners on samples, so that edges pass through others, too.
                            for (ScreenVertex& v : polygon) {
                              if (random.below(2) == 0) v.x = v.x >> bits << bits, v.y = v.y >> bits << bits;
                            }
                            if (ring.empty() && twice_area(polygon) == 0) return {};
                            if (!ring.empty() && !is_simple(corners_of(polygon))) return {};
                            return difference_from_cgal(polygon, random, 3, bits);
                          }),
            "");
}

TEST(Coverage, AgreesWithCgalAtEverySampleOfSmallPolygons) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random("coverage/small", i, 1);
    const TestPolygon polygon = polygon_of(random_simple_polygon(random, random.between(3, 10), 8, 8));
    const Bitmap masks = coverage_masks(polygon, {0, 0, 9, 9});
    const auto ring = to_cgal(polygon);
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 9; ++x)
        ASSERT_EQ(masks.get(x, y), cgal_mask(ring, x, y)) << i << ": " << x << " " << y;
    }
  }
}

std::int64_t boundary_points(const TestPolygon& polygon) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ScreenVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    sum += std::gcd(b.x - a.x, b.y - a.y);
  }
  return sum;
}

TEST(Coverage, ObeysPicksLaw) {
  // 5000 by default, 10^6 with FAROP_LONG_TESTS=1.
  const std::uint64_t count = repetitions(5000, 1'000'000);
  for (std::uint64_t i = 0; i < count; ++i) {
    Random random("coverage/pick", i, 1);
    const TestPolygon polygon = polygon_of(random_simple_polygon(random, random.between(3, 16), 40, 40));
    Bitmap masks = coverage_masks(polygon, bounds(polygon, k_frame));
    mark_boundary(polygon, masks, 0);
    const std::int64_t inner = std::ranges::count(masks.at, 0xFF);
    ASSERT_EQ(std::abs(twice_area(polygon)), 2 * inner + boundary_points(polygon) - 2) << i;
    ASSERT_EQ(inner, std::ranges::count_if(masks.at, [](std::uint8_t m) { return m != 0; }))
        << "off the boundary all rules agree";
  }
}

TEST(Coverage, OfAParallelogramIsItsDeterminantUnderEveryRule) {
  // 5000 by default, 10^6 with FAROP_LONG_TESTS=1.
  const std::uint64_t count = repetitions(5000, 1'000'000);
  for (std::uint64_t i = 0; i < count; ++i) {
    Random random("coverage/parallelogram", i, 1);
    const Point o{30, 30}, u{random.between(-15, 15), random.between(-15, 15)},
        v{random.between(-15, 15), random.between(-15, 15)};
    const TestPolygon polygon =
        polygon_of({o, {o.x + u.x, o.y + u.y}, {o.x + u.x + v.x, o.y + u.y + v.y}, {o.x + v.x, o.y + v.y}});
    const Bitmap masks = coverage_masks(polygon, window_of(k_frame));
    for (unsigned rule = 0; rule < 8; ++rule) {
      const auto covered =
          std::ranges::count_if(masks.at, [&](std::uint8_t m) { return (m >> rule & 1) != 0; });
      ASSERT_EQ(covered, std::abs(u.x * v.y - u.y * v.x)) << i << " rule " << rule;
    }
  }
}

TEST(Coverage, OfATilingIsOneEverywhereUnderEveryRule) {
  // 50 by default, 10^4 with FAROP_LONG_TESTS=1.
  const std::uint64_t count = repetitions(50, 10'000);
  for (std::uint64_t i = 0; i < count; ++i) {
    Random random("coverage/tiling", i, 1);
    const Window window = window_of(k_frame);
    std::array<std::vector<int>, 8> covered;
    covered.fill(std::vector<int>(window.samples()));
    const auto mesh = random_mesh(random, random.between(4, 100), 64, 64);
    std::int64_t area = 0;
    for (const TestPolygon& polygon : mesh) {
      area += twice_area(polygon);
      const Bitmap masks = coverage_masks(polygon, window);
      for (std::size_t s = 0; s < masks.at.size(); ++s) {
        for (unsigned rule = 0; rule < 8; ++rule) covered[rule][s] += masks.at[s] >> rule & 1;
      }
    }
    ASSERT_EQ(area, 2 * 63 * 63);
    // Under lb the last column and the top row are nobody's; and so on for the others.
    const std::array<std::array<int, 4>, 4> owned = {
        {{0, 0, 63, 63}, {0, 1, 63, 64}, {1, 0, 64, 63}, {1, 1, 64, 64}}};
    for (unsigned rule = 0; rule < 8; ++rule) {
      const auto& [x0, y0, x1, y1] = owned[rule % 4];
      const Window inside{x0, y0, x1, y1};
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
          ASSERT_EQ(covered[rule][window.index(x, y)], inside.contains(x, y) ? 1 : 0)
              << i << " rule " << rule << ": " << x << " " << y;
        }
      }
    }
  }
}

TEST(Coverage, FollowsTheEightSymmetriesOfTheSquare) {
  using enum ConsistentRule;
  struct Symmetry {
    std::function<Point(Point)> map;
    std::array<ConsistentRule, 8> rules;  ///< what lb, lt, rb, rt, lb2, lt2, rb2, rt2 become
  };
  constexpr int n = 20;
  const std::array<Symmetry, 3> generators = {{
      {[](Point p) {
         return Point{n - p.x, p.y};
       },
       {rb, rt, lb, lt, rb2, rt2, lb2, lt2}},
      {[](Point p) {
         return Point{p.x, n - p.y};
       },
       {lt, lb, rt, rb, lt2, lb2, rt2, rb2}},
      {[](Point p) {
         return Point{p.y, p.x};
       },
       {lb2, rb2, lt2, rt2, lb, rb, lt, rt}},
  }};  // the other five are products of these
  for (std::uint64_t i = 0; i < 500; ++i) {
    Random random("coverage/symmetry", i, 1);
    const Points ring = random_simple_polygon(random, random.between(3, 12), n + 1, n + 1);
    const Bitmap plain = coverage_masks(polygon_of(ring), {0, 0, n + 1, n + 1});
    for (const Symmetry& symmetry : generators) {
      Points image;
      for (const Point& p : ring) image.push_back(symmetry.map(p));
      const Bitmap masks = coverage_masks(polygon_of(image), {0, 0, n + 1, n + 1});
      for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
          const Point to = symmetry.map({x, y});
          for (unsigned rule = 0; rule < 8; ++rule) {
            ASSERT_EQ(plain.get(x, y) >> rule & 1,
                      (masks.get(to.x, to.y) & rule_bit(symmetry.rules[rule])) != 0)
                << i << " rule " << rule;
          }
        }
      }
    }
  }
}

TEST(Coverage, OfTheLecturesPolygonIsAsPrinted) {
  const TestPolygon lecture = polygon_of({{0, 1}, {2, 8}, {4, 6}, {7, 8}, {9, 4}, {6, 1}});
  const Bitmap masks = coverage_masks(lecture, {0, 0, 12, 12});
  constexpr std::array totals = {43, 37, 48, 42, 44, 41, 44, 41};
  for (unsigned rule = 0; rule < 8; ++rule) {
    EXPECT_EQ(std::ranges::count_if(masks.at, [&](std::uint8_t m) { return (m >> rule & 1) != 0; }),
              totals[rule])
        << rule;
  }
  const std::array<std::string_view, 9> rows = {"",        "012345", "123456", "1234567", "12345678",
                                                "2345678", "234567", "267",    ""};
  for (int y = 0; y < 9; ++y) {
    std::string row;
    for (int x = 0; x < 10; ++x) {
      if ((masks.get(x, y) & 1) != 0) row += static_cast<char>('0' + x);
    }
    EXPECT_EQ(row, rows[static_cast<std::size_t>(y)]) << y;
  }
}

TEST(Coverage, IsExactFarOutsideTheFrame) {
  constexpr std::int32_t far = (1 << 30) - 1;
  // Two halves of a huge square, cut along a diagonal that passes through the frame's diagonal.
  const TestPolygon lower = polygon_of({{-far, -far}, {far, -far}, {far, far}});
  const TestPolygon upper = polygon_of({{-far, -far}, {far, far}, {-far, far}});
  const Bitmap a = coverage_masks(lower, window_of(k_frame)), b = coverage_masks(upper, window_of(k_frame));
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      EXPECT_EQ(a.get(x, y) ^ b.get(x, y), 0xFF);
      if (x != y) {
        EXPECT_EQ(a.get(x, y), x > y ? 0xFF : 0);
      }
    }
  }
}

TEST(RandomNumbers, AreTheWellKnownOnes) {
  EXPECT_EQ(Random(0).next(), 0xE220A8397B1DCDAFu);
  EXPECT_EQ(fnv1a(""), 0xCBF29CE484222325u);
  EXPECT_EQ(fnv1a("a"), 0xAF63DC4C8601EC8Cu);
  EXPECT_EQ(fnv1a("b", fnv1a("a")), fnv1a("ab"));
}

}  // namespace
}  // namespace farop::conformance
