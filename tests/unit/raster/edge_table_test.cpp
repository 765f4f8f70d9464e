// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/edge_table.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <numbers>

#include "raster/reference.h"
#include "unit/raster/raster_test_support.h"

namespace farop::test {
namespace {

std::vector<int> coverage_of(const Corners& corners, int subpixel_bits, int width, int height) {
  std::vector<int> count(static_cast<std::size_t>(width * height));
  EdgeTable table(width, height, subpixel_bits);
  add_coverage(count, table, corners, width);
  return count;
}

std::int64_t total(const std::vector<int>& count) {
  return std::accumulate(count.begin(), count.end(), 0);
}

void expect_reference_coverage(const Corners& corners, int subpixel_bits, int width, int height) {
  const std::vector<int> fast = coverage_of(corners, subpixel_bits, width, height);
  const std::vector<std::uint8_t> exact = reference::coverage(corners, subpixel_bits, width, height);
  ASSERT_TRUE(std::equal(fast.begin(), fast.end(), exact.begin(), exact.end()))
      << corners.size() << " corners, " << subpixel_bits << " bits, " << width << " x " << height;
}

TEST(EdgeTable, CoversTheLectureExampleRowByRow) {
  const Corners lecture = {vertex(0, 1), vertex(2, 8), vertex(4, 6),
                           vertex(7, 8), vertex(9, 4), vertex(6, 1)};
  const char* const rows[] = {"..........", "######....", ".######...", ".#######..", ".########.",
                              "..#######.", "..######..", "..#...##..", ".........."};
  const std::vector<int> count = coverage_of(lecture, 0, 10, 9);
  for (int y = 0; y < 9; ++y) {
    std::string row;
    for (int x = 0; x < 10; ++x) row += count[index_of(x, y, 10)] == 1 ? '#' : '.';
    EXPECT_EQ(row, rows[y]) << "row " << y;
  }
  EXPECT_EQ(total(count), 43);
}

TEST(EdgeTable, MeasuresSpansFromTheExactCrossings) {
  const Corners lecture = {vertex(0, 1), vertex(2, 8), vertex(4, 6),
                           vertex(7, 8), vertex(9, 4), vertex(6, 1)};
  EdgeTable table(10, 9, 0);
  table.load(lecture);
  do {
    ASSERT_TRUE(table.next_row());
  } while (table.row() < 5);
  ASSERT_EQ(table.spans().size(), 1u);  // from 8/7 to 8 1/2
  EXPECT_EQ(table.spans()[0].first, 2);
  EXPECT_EQ(table.spans()[0].end, 9);
  EXPECT_DOUBLE_EQ(table.spans()[0].distance(table.spans()[0].first), 2 - 8.0 / 7);
  EXPECT_DOUBLE_EQ(table.spans()[0].width, 8.5 - 8.0 / 7);
  EXPECT_DOUBLE_EQ(table.spans()[0].left.along, 4.0 / 7);
  EXPECT_DOUBLE_EQ(table.spans()[0].right.along, 1.0 / 4);
}

// Also where several crossings lie between the same two columns, which coverage alone does not show.
TEST(EdgeTable, PairsCrossingsFromLeftToRight) {
  Random random(8);
  EdgeTable table(20, 20, 8);
  for (int i = 0; i < 3000; ++i) {
    const Corners corners = random_polygon(random, k_shapes[i % 5], 0, 19 * 256, 0, 19 * 256);
    table.load(corners);
    while (table.next_row()) {
      double last_right = -1;
      for (const Span& span : table.spans()) {
        const double left = span.first - span.distance(span.first);
        ASSERT_GE(left, last_right - 1e-9) << "polygon " << i << " row " << table.row();
        ASSERT_GT(span.width, 0);
        last_right = left + span.width;
      }
    }
  }
}

TEST(EdgeTable, MatchesTheReferenceOnAllSmallTriangles) {
  for (int a = 0; a < 16; ++a) {
    for (int b = 0; b < 16; ++b) {
      for (int c = 0; c < 16; ++c) {
        expect_reference_coverage({vertex(a % 4, a / 4), vertex(b % 4, b / 4), vertex(c % 4, c / 4)}, 0, 4,
                                  4);
      }
    }
  }
}

TEST(EdgeTable, MatchesTheReferenceOnRandomPolygonsInsideAndOutsideTheFrame) {
  Random random(1);
  for (const int bits : {0, 1, 4, 8}) {
    for (const Shape shape : k_shapes) {
      for (int i = 0; i < 1500; ++i) {
        const int width = random.integer(1, 24), height = random.integer(1, 24);
        const std::int64_t w = std::int64_t{width} << bits, h = std::int64_t{height} << bits;
        const std::int64_t half = (std::int64_t{1} << bits) / 2;
        Corners corners;
        switch (i % 3) {
          case 0:
            corners = random_polygon(random, shape, 0, w - 1, 0, h - 1);
            break;
          case 1:  // a border of half a pixel
            corners = random_polygon(random, shape, -half, w - half, -half, h - half);
            break;
          default:
            corners = random_polygon(random, shape, -2 * w, 3 * w, -2 * h, 3 * h);
        }
        expect_reference_coverage(corners, bits, width, height);
      }
    }
  }
}

TEST(EdgeTable, MatchesTheReferenceOnTheLargestIntegers) {
  Random random(2);
  constexpr std::int64_t k_low = std::numeric_limits<std::int32_t>::min();
  constexpr std::int64_t k_high = std::numeric_limits<std::int32_t>::max();
  for (const int bits : {0, 8}) {
    for (int i = 0; i < 2000; ++i) {
      Corners corners = random_polygon(random, k_shapes[i % 5], k_low, k_high, k_low, k_high);
      if (i % 2 == 0) corners.push_back(vertex(k_low, k_high)), corners.push_back(vertex(k_high, k_low));
      corners.push_back(vertex(random.between(0, 20) << bits, random.between(0, 20) << bits));
      expect_reference_coverage(corners, bits, 20, 20);
    }
  }
}

TEST(EdgeTable, IsExactAtTheLargestSuperSampledFrame) {
  Random random(3);
  constexpr int k_size = 32767 * 16;
  constexpr int k_bits = 8;
  EdgeTable table(k_size, k_size, k_bits);
  for (int i = 0; i < 12; ++i) {
    const std::int64_t top = (std::int64_t{k_size - 1} << k_bits);
    const Corners corners = random_polygon(random, Shape::triangle, 0, top, 0, top);
    table.load(corners);
    std::int64_t wrong = 0;
    while (table.next_row()) {
      const auto covered = [&](int x) { return reference::covers(corners, k_bits, x, table.row()); };
      ASSERT_LE(table.spans().size(), 1u);
      if (table.spans().empty()) {
        wrong += covered(random.integer(0, k_size - 1)) ? 1 : 0;
        continue;
      }
      const Span& span = table.spans()[0];
      wrong += !covered(span.first) + !covered(span.end - 1) + covered(span.first - 1) + covered(span.end);
    }
    EXPECT_EQ(wrong, 0);
  }
}

TEST(EdgeTable, DrawsNothingForZeroHeightOrWidth) {
  EXPECT_EQ(total(coverage_of({vertex(1, 5), vertex(4, 5), vertex(9, 5), vertex(2, 5)}, 0, 12, 12)), 0);
  EXPECT_EQ(total(coverage_of({vertex(5, 1), vertex(5, 4), vertex(5, 9), vertex(5, 2)}, 0, 12, 12)), 0);
  EXPECT_EQ(total(coverage_of({vertex(1, 1), vertex(8, 9), vertex(1, 1)}, 0, 12, 12)), 0);
  EXPECT_EQ(total(coverage_of({vertex(5, 5)}, 0, 12, 12)), 0);
  EXPECT_EQ(total(coverage_of({}, 0, 12, 12)), 0);
}

TEST(EdgeTable, LeavesLastColumnAndTopRowOfAFullScreenRectangle) {
  for (const auto& [w, h] : {std::pair(1, 1), std::pair(2, 2), std::pair(3, 5), std::pair(61, 67)}) {
    const Corners full = {vertex(0, 0), vertex(w - 1, 0), vertex(w - 1, h - 1), vertex(0, h - 1)};
    EXPECT_EQ(total(coverage_of(full, 0, w, h)), (w - 1) * (h - 1));
  }
  const int half = 128;  // 8 sub-pixel bits and a border of half a pixel: every pixel
  const Corners full = {vertex(-half, -half), vertex(61 * 256 - half, -half),
                        vertex(61 * 256 - half, 67 * 256 - half), vertex(-half, 67 * 256 - half)};
  EXPECT_EQ(total(coverage_of(full, 8, 61, 67)), 61 * 67);
}

TEST(EdgeTable, CoversAsManySamplesOfALatticeParallelogramAsItsDeterminant) {
  Random random(4);
  for (int i = 0; i < 5000; ++i) {
    const int ax = random.integer(-15, 15), ay = random.integer(-15, 15);
    const int bx = random.integer(-15, 15), by = random.integer(-15, 15);
    const int x = random.integer(30, 34), y = random.integer(30, 34);
    const Corners parallelogram = {vertex(x, y), vertex(x + ax, y + ay), vertex(x + ax + bx, y + ay + by),
                                   vertex(x + bx, y + by)};
    ASSERT_EQ(total(coverage_of(parallelogram, 0, 65, 65)), std::abs(ax * by - ay * bx));
  }
}

TEST(EdgeTable, CoversEverySampleOnceInRandomTriangulations) {
  Random random(5);
  constexpr int k_size = 48;
  for (int i = 0; i < 300; ++i) {
    const int bits = (i % 4) * 2, last = (k_size - 1) << bits;
    std::vector<Corners> triangles = {{vertex(0, 0), vertex(last, 0), vertex(last, last)},
                                      {vertex(0, 0), vertex(last, last), vertex(0, last)}};
    // A point splits the first triangle that holds it, borders included: a point on an edge leaves a
    // T-junction whose stem ends exactly on the lattice, and triangles without area.
    for (int points = random.integer(1, 120); points > 0; --points) {
      const ScreenVertex p = vertex(random.integer(0, last), random.integer(0, last));
      const auto side = [&](const ScreenVertex& a, const ScreenVertex& b) {
        return std::int64_t{b.x - a.x} * (p.y - a.y) - std::int64_t{b.y - a.y} * (p.x - a.x);
      };
      const auto holds = [&](const Corners& t) {
        return side(t[0], t[1]) >= 0 && side(t[1], t[2]) >= 0 && side(t[2], t[0]) >= 0;
      };
      const auto found = std::find_if(triangles.begin(), triangles.end(), holds);
      ASSERT_NE(found, triangles.end());
      const Corners t = *found;
      *found = {t[0], t[1], p};
      triangles.push_back({t[1], t[2], p});
      triangles.push_back({t[2], t[0], p});
    }
    std::vector<int> count(k_size * k_size);
    EdgeTable table(k_size, k_size, bits);
    for (const Corners& t : triangles) add_coverage(count, table, t, k_size);
    for (int y = 0; y < k_size; ++y) {
      for (int x = 0; x < k_size; ++x) {
        const int expected = x < k_size - 1 && y < k_size - 1 ? 1 : 0;
        ASSERT_EQ(count[index_of(x, y, k_size)], expected) << x << ' ' << y << " tiling " << i;
      }
    }
  }
}

TEST(EdgeTable, CoversEverySampleOnceInFans) {
  constexpr int k_size = 41;
  for (int spokes = 4; spokes <= 160; spokes += 4) {
    Corners rim;  // on the border of the frame, counter-clockwise
    for (int i = 0; i < spokes; ++i) {
      const int along = (k_size - 1) * (4 * i % spokes) / spokes, last = k_size - 1;
      const ScreenVertex sides[] = {vertex(along, 0), vertex(last, along), vertex(last - along, last),
                                    vertex(0, last - along)};
      rim.push_back(sides[4 * i / spokes]);
    }
    Random random(static_cast<std::uint64_t>(spokes));
    const ScreenVertex hub = vertex(random.integer(1, k_size - 2), random.integer(1, k_size - 2));
    std::vector<int> count(k_size * k_size);
    EdgeTable table(k_size, k_size, 0);
    for (std::size_t i = 0; i < rim.size(); ++i) {
      add_coverage(count, table, Corners{hub, rim[i], rim[(i + 1) % rim.size()]}, k_size);
    }
    EXPECT_EQ(total(count), (k_size - 1) * (k_size - 1)) << spokes;
    EXPECT_EQ(*std::max_element(count.begin(), count.end()), 1) << spokes;
  }
}

TEST(EdgeTable, FitsAConcavePolygonIntoItsBridgedComplement) {
  Random random(6);
  constexpr int k_size = 40;
  for (int i = 0; i < 1500; ++i) {
    const Corners inner = random_polygon(random, Shape::star, 0, k_size - 1, 0, k_size - 1);
    // Frame, along a bridge to the polygon, round it the other way, and back over the bridge.
    Corners outer = {vertex(0, 0), vertex(k_size - 1, 0), vertex(k_size - 1, k_size - 1),
                     vertex(0, k_size - 1), vertex(0, 0)};
    outer.push_back(inner.front());
    outer.insert(outer.end(), inner.rbegin(), inner.rend());
    std::vector<int> count(k_size * k_size);
    EdgeTable table(k_size, k_size, 0);
    add_coverage(count, table, inner, k_size);
    add_coverage(count, table, outer, k_size);
    ASSERT_EQ(total(count), (k_size - 1) * (k_size - 1));
    ASSERT_EQ(*std::max_element(count.begin(), count.end()), 1);
  }
}

TEST(EdgeTable, ReportsTheSameSpansFromEveryStartAndInBothDirections) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    Corners corners = random_polygon(random, k_shapes[i % 5], 0, 30 * 16, 0, 30 * 16);
    const auto spans_of = [](const Corners& c) {
      std::vector<double> spans;
      EdgeTable table(31, 31, 4);
      table.load(c);
      while (table.next_row()) {
        for (const Span& s : table.spans()) {
          for (const EdgePoint& p : {s.left, s.right}) {
            spans.insert(spans.end(), {double(c[p.bottom].x), double(c[p.bottom].y), double(c[p.top].x),
                                       double(c[p.top].y), p.along});
          }
          spans.insert(spans.end(),
                       {double(table.row()), double(s.first), double(s.end), s.distance(s.first), s.width});
        }
      }
      return spans;
    };
    const std::vector<double> expected = spans_of(corners);
    std::rotate(corners.begin(), corners.begin() + random.integer(1, 2), corners.end());
    ASSERT_EQ(spans_of(corners), expected);
    std::reverse(corners.begin(), corners.end());
    ASSERT_EQ(spans_of(corners), expected);
  }
}

// A comb of 50,000 teeth has all its edges active at once, a circle of 100,000 corners two at a time.
// Quadratic tables would take minutes; the bound is generous for slow machines and sanitizers.
TEST(EdgeTable, HandlesAHundredThousandCornersInNearlyLinearTime) {
  const auto start = std::chrono::steady_clock::now();
  Corners comb;
  for (int i = 0; i < 50000; ++i) comb.push_back(vertex(4 * i, 0)), comb.push_back(vertex(4 * i + 2, 256));
  comb.push_back(vertex(200000, 0)), comb.push_back(vertex(200000, -256)), comb.push_back(vertex(0, -256));
  EdgeTable table(800, 64, 2);
  std::vector<int> count(800 * 64);
  add_coverage(count, table, comb, 800);
  EXPECT_EQ(count[0], 1);

  Corners circle;
  for (int i = 0; i < 100000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 100000;
    circle.push_back(
        vertex(std::lround(130000 * (1 + std::cos(angle))), std::lround(130000 * (1 + std::sin(angle)))));
  }
  EdgeTable big(1020, 1020, 8);
  count.assign(1020 * 1020, 0);
  add_coverage(count, big, circle, 1020);
  const double radius = 130000.0 / 256;
  EXPECT_NEAR(static_cast<double>(total(count)), std::numbers::pi * radius * radius, 300);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

}  // namespace
}  // namespace farop::test
