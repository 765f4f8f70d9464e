// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/triangulate.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "geometry/clip.h"
#include "geometry/predicates.h"
#include "unit/geometry/lattice_polygons.h"

namespace farop {
namespace {

using lattice::below;
using lattice::fault;
using lattice::Polygon;
using lattice::to_space;
using lattice::to_string;

const V3d k_towards_z(0, 0, 1);

std::vector<CornerTriangle> triangles_of(const std::vector<V3d>& corners, const V3d& normal = k_towards_z) {
  static TriangulateScratch scratch;  // reused on purpose: nothing may leak from one polygon to the next
  std::vector<CornerTriangle> triangles{{7, 7, 7}};
  triangulate(corners, normal, triangles, scratch);
  return triangles;
}

std::vector<CornerTriangle> reference_triangles_of(const std::vector<V3d>& corners,
                                                   const V3d& normal = k_towards_z) {
  std::vector<CornerTriangle> triangles;
  reference::triangulate(corners, normal, triangles);
  return triangles;
}

std::string fault_of(const Polygon& polygon) {
  return fault(polygon, triangles_of(to_space(polygon)));
}

/// How many triangles have no area.
std::int64_t flat_triangles(const Polygon& polygon, const std::vector<CornerTriangle>& triangles) {
  return std::ranges::count_if(triangles, [&](const CornerTriangle& t) {
    return lattice::doubled_area(polygon[t[0]], polygon[t[1]], polygon[t[2]]) == 0;
  });
}

struct Record {
  std::string file;
  std::string name;
  Polygon polygon;
};

std::ostream& operator<<(std::ostream& os, const Record& record) {
  return os << record.file << ": " << to_string(record.polygon);
}

std::vector<Record> read_corpus() {
  std::vector<Record> records;
  for (const auto& entry : std::filesystem::directory_iterator(FAROP_SOURCE_DIR "/tests/corpus/polygons")) {
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::string word;
      if (!(words >> word) || word == "#") continue;
      if (word == "name") {
        words >> word;
        records.push_back({entry.path().stem().string(), word, {}});
        continue;
      }
      std::istringstream numbers(line);
      for (lattice::Point p; numbers >> p.x >> p.y;) records.back().polygon.push_back(p);
    }
  }
  std::ranges::sort(records, {}, [](const Record& r) { return r.file + r.name; });
  return records;
}

std::string test_name(const testing::TestParamInfo<Record>& info) {
  std::string name = info.param.file + "_" + info.param.name;
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class TriangulateCorpus : public testing::TestWithParam<Record> {
 protected:
  const Polygon& polygon() const { return GetParam().polygon; }
  bool crosses_itself() const { return GetParam().file == "self_crossing"; }

  /// The checks that hold for a polygon however it is turned.
  void expect_good(const Polygon& ring, const std::vector<CornerTriangle>& triangles) const {
    if (crosses_itself()) {
      EXPECT_EQ(triangles.size() + 2, ring.size());
    } else {
      EXPECT_EQ(fault(ring, triangles), "") << to_string(ring);
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Polygons, TriangulateCorpus, testing::ValuesIn(read_corpus()), test_name);

TEST(TriangulateCorpusFiles, AreAllThere) {
  std::set<std::string> files;
  for (const Record& r : read_corpus()) files.insert(r.file);
  EXPECT_EQ(files, (std::set<std::string>{"clipped", "collinear", "needles", "self_crossing", "simple",
                                          "touching"}));
}

TEST_P(TriangulateCorpus, TilesThePolygonAsGiven) {
  expect_good(polygon(), triangles_of(to_space(polygon())));
}

TEST_P(TriangulateCorpus, TilesThePolygonReversed) {
  const Polygon reversed(polygon().rbegin(), polygon().rend());
  expect_good(reversed, triangles_of(to_space(reversed)));
}

TEST_P(TriangulateCorpus, TilesThePolygonFromEveryStart) {
  Polygon rotated = polygon();
  for (std::size_t start = 0; start < polygon().size(); ++start) {
    expect_good(rotated, triangles_of(to_space(rotated)));
    std::rotate(rotated.begin(), rotated.begin() + 1, rotated.end());
  }
}

TEST_P(TriangulateCorpus, TilesThePolygonMirrored) {
  Polygon mirrored = polygon();
  for (lattice::Point& p : mirrored) p.x = -p.x;
  expect_good(mirrored, triangles_of(to_space(mirrored)));
  for (lattice::Point& p : mirrored) p = {p.y, p.x};
  expect_good(mirrored, triangles_of(to_space(mirrored)));
}

TEST_P(TriangulateCorpus, CutsTheSameFarFromTheOrigin) {
  std::vector<V3d> far = to_space(polygon());
  for (V3d& p : far) p += V3d(0x1p45, -0x1p44, 0);  // still exact
  expect_good(polygon(), triangles_of(far));
  if (!crosses_itself()) {
    EXPECT_EQ(triangles_of(far), triangles_of(to_space(polygon())));
  }
}

TEST_P(TriangulateCorpus, CutsTheSameAtEveryScale) {
  for (const double scale : {0x1p-300, 0x1p-100, 0x1p100, 0x1p300}) {
    std::vector<V3d> scaled = to_space(polygon());
    for (V3d& p : scaled) p *= scale;
    EXPECT_EQ(triangles_of(scaled), triangles_of(to_space(polygon()))) << scale;
  }
}

TEST_P(TriangulateCorpus, TilesThePolygonInEveryPlane) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<V3d> tilted;
    for (const lattice::Point& p : polygon()) {
      V3d q;
      q[(axis + 1) % 3] = static_cast<double>(p.x);
      q[(axis + 2) % 3] = static_cast<double>(p.y);
      q[axis] = static_cast<double>(p.x - p.y);  // gives ears other sizes, too
      tilted.push_back(q);
    }
    V3d normal(0.5);
    normal[axis] = -2;
    expect_good(polygon(), triangles_of(tilted, normal));
    EXPECT_EQ(triangles_of(tilted, normal), triangles_of(tilted, -normal));
  }
}

TEST_P(TriangulateCorpus, CutsAsTheReferenceDoes) {
  EXPECT_EQ(triangles_of(to_space(polygon())), reference_triangles_of(to_space(polygon())));
}

TEST_P(TriangulateCorpus, NeedsNoFlatTriangleForASimplePolygon) {
  const std::string& file = GetParam().file;
  if (file == "simple" || file == "collinear") {
    EXPECT_EQ(flat_triangles(polygon(), triangles_of(to_space(polygon()))), 0);
  }
}

TEST(Triangulate, CutsTheSmallestEarFirst) {
  // Squares of the distances between the neighbours of each corner: 20, 34, 17, 26, 25.
  const std::vector<V3d> corners{{0, 0, 0}, {4, 0, 0}, {5, 3, 0}, {3, 4, 0}, {0, 2, 0}};
  EXPECT_EQ(triangles_of(corners)[0], (CornerTriangle{1, 2, 3}));
}

TEST(Triangulate, CutsTheFirstOfEqualEars) {
  EXPECT_EQ(triangles_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}),
            (std::vector<CornerTriangle>{{3, 0, 1}, {1, 2, 3}}));
}

TEST(Triangulate, MeasuresEarsInSpace) {
  // Seen from above all four ears of the square are alike; in space the diagonal 0-2 is the shorter one.
  const std::vector<V3d> corners{{0, 0, 0}, {1, 0, 5}, {1, 1, 0}, {0, 1, -5}};
  EXPECT_EQ(triangles_of(corners)[0], (CornerTriangle{0, 1, 2}));
}

TEST(Triangulate, LeavesOutTheLargestCoordinateOfTheNormal) {
  // Upright in the plane x = 0; without y or z nothing would be left of it.
  const std::vector<V3d> dart{{0, 0, 0}, {0, 6, 3}, {0, 0, 6}, {0, 2, 3}};
  const std::vector<CornerTriangle> triangles = triangles_of(dart, V3d(-3, 1, 2));
  ASSERT_EQ(triangles.size(), 2u);
  for (const CornerTriangle& t : triangles) {
    EXPECT_TRUE(std::ranges::find(t, 3u) != t.end()) << "both triangles end at the reflex corner";
  }
}

TEST(Triangulate, CutsAnEarThatAnotherPartOfTheRingRunsAlong) {
  // The tip (0,-4) fills a notch exactly. Both of its edges coincide with edges of the notch, which lies
  // beyond them.
  const Polygon ring{{10, 0}, {1, 8}, {-1, 8}, {-1, 0}, {0, -4},  {1, 0},     {1, 8},
                     {10, 0}, {1, 0}, {0, -4}, {-1, 0}, {-10, 0}, {-10, -10}, {10, -10}};
  EXPECT_EQ(fault_of(ring), "");
  EXPECT_EQ(triangles_of(to_space(ring))[0], (CornerTriangle{3, 4, 5}));
}

TEST(Triangulate, CutsAnEarBesideAPointThatTheRingPassesTwice) {
  // A small triangle hangs on a large quadrilateral by the corner (1,1): nothing is in the way of its ear.
  const Polygon ring{{0, 0}, {2, 0}, {1, 1}, {9, 5}, {9, 9}, {1, 9}, {1, 1}};
  EXPECT_EQ(fault_of(ring), "");
  EXPECT_EQ(triangles_of(to_space(ring))[0], (CornerTriangle{6, 0, 1}));
}

TEST(Triangulate, LeavesNothingForFewerThanThreeCorners) {
  EXPECT_TRUE(triangles_of({}).empty());
  EXPECT_TRUE(triangles_of({{0, 0, 0}}).empty());
  EXPECT_TRUE(triangles_of({{0, 0, 0}, {1, 0, 0}}).empty());
}

TEST(Triangulate, KeepsATriangle) {
  EXPECT_EQ(triangles_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), (std::vector<CornerTriangle>{{0, 1, 2}}));
  EXPECT_EQ(triangles_of({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}), (std::vector<CornerTriangle>{{0, 1, 2}}));
}

TEST(Triangulate, CutsPolygonsWithInfiniteOrMissingNumbers) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {inf, -inf, nan}) {
    EXPECT_EQ(triangles_of({{0, 0, 0}, {1, 0, 0}, {1, bad, 0}, {0, 1, 0}, {0, 0.5, bad}}).size(), 3u);
  }
  EXPECT_EQ(triangles_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, V3d(nan)).size(), 2u);
  EXPECT_EQ(triangles_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, V3d(0)).size(), 2u);
}

TEST(Triangulate, CutsPolygonsAtTheEndsOfTheNumberRange) {
  constexpr double most = std::numeric_limits<double>::max();
  constexpr double least = std::numeric_limits<double>::denorm_min();
  for (const double s : {most, most / 3, least, 8 * least}) {
    const std::vector<V3d> corners{{-s, -s, 0}, {s, -s, 0}, {0, 0, 0}, {s, s, 0}, {-s, s, 0}};
    const std::vector<CornerTriangle> triangles = triangles_of(corners);
    const Polygon shape{{-1, -1}, {1, -1}, {0, 0}, {1, 1}, {-1, 1}};
    EXPECT_EQ(fault(shape, triangles), "") << s;
  }
}

/// Corners in space above a lattice polygon, at random heights: the tests see the same polygon, but the
/// ears have other sizes and are cut in another order.
std::vector<V3d> with_random_heights(lattice::Random& random, const Polygon& polygon) {
  std::vector<V3d> corners = to_space(polygon);
  for (V3d& p : corners) p.z = 1e5 * static_cast<double>(below(random, 50));
  return corners;
}

void expect_tiled_like_reference(lattice::Random& random, const Polygon& polygon) {
  const std::vector<V3d> level = to_space(polygon);
  for (const std::vector<V3d>& corners : {level, with_random_heights(random, polygon)}) {
    const std::vector<CornerTriangle> triangles = triangles_of(corners);
    ASSERT_EQ(fault(polygon, triangles), "") << to_string(polygon);
    ASSERT_EQ(triangles, reference_triangles_of(corners)) << to_string(polygon);
  }
}

TEST(TriangulateRandom, TilesSimplePolygonsWithoutFlatTriangles) {
  lattice::Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const int corners = 3 + static_cast<int>(below(random, 40));
    const Polygon polygon = lattice::random_simple(random, corners, 3 + below(random, 25));
    ASSERT_NO_FATAL_FAILURE(expect_tiled_like_reference(random, polygon));
    ASSERT_EQ(flat_triangles(polygon, triangles_of(to_space(polygon))), 0) << to_string(polygon);
  }
}

TEST(TriangulateRandom, TilesPolygonsWithNeedles) {
  lattice::Random random(2);
  for (int i = 0; i < 3000; ++i) {
    const int corners = 3 + static_cast<int>(below(random, 20));
    const Polygon polygon = lattice::random_simple(random, corners, 3 + below(random, 12));
    const int needles = 1 + static_cast<int>(below(random, 12));
    ASSERT_NO_FATAL_FAILURE(
        expect_tiled_like_reference(random, lattice::with_needles(random, polygon, needles)));
  }
}

TEST(TriangulateRandom, TilesPolygonsThatTouchThemselves) {
  lattice::Random random(3);
  for (int i = 0; i < 3000; ++i) {
    const int corners = 4 + static_cast<int>(below(random, 30));
    ASSERT_NO_FATAL_FAILURE(expect_tiled_like_reference(
        random, lattice::random_weakly_simple(random, corners, 2 + below(random, 6), false)));
  }
}

TEST(TriangulateRandom, TilesPolygonsThatHangTogetherByLines) {
  lattice::Random random(4);
  for (int i = 0; i < 5000; ++i) {
    const int corners = 4 + static_cast<int>(below(random, 30));
    Polygon polygon = lattice::random_weakly_simple(random, corners, 2 + below(random, 8), true);
    if (i % 2 == 1) polygon = lattice::with_needles(random, polygon, 1 + static_cast<int>(below(random, 6)));
    ASSERT_NO_FATAL_FAILURE(expect_tiled_like_reference(random, polygon));
  }
}

TEST(TriangulateRandom, TilesWhatClippingLeavesOfConcavePolygons) {
  lattice::Random random(5);
  int clipped = 0;
  for (int i = 0; i < 4500; ++i) {
    const int corners = 4 + static_cast<int>(below(random, 30));
    const Polygon whole = i % 3 == 0   ? lattice::random_simple(random, corners, 13)
                          : i % 3 == 1 ? lattice::random_weakly_simple(random, corners, 9, false)
                                       : lattice::random_weakly_simple(random, corners, 9, true);
    Polygon rest = lattice::scaled(whole, lattice::k_clip_scale);
    for (int plane = 0; plane < 4; ++plane) {
      const std::int64_t limit = (1 + below(random, 10)) * lattice::k_clip_scale;
      rest = lattice::clip(rest, static_cast<int>(below(random, 2)), limit, below(random, 2) == 0);
      if (rest.size() < 3) break;
      ++clipped;
      ASSERT_NO_FATAL_FAILURE(expect_tiled_like_reference(random, rest));
    }
  }
  EXPECT_GT(clipped, 7000);
}

TEST(TriangulateRandom, CutsSelfCrossingPolygonsTheSameEveryTime) {
  lattice::Random random(6);
  for (int i = 0; i < 5000; ++i) {
    const std::int64_t size = 2 + below(random, 30);
    std::vector<V3d> corners(4 + static_cast<std::size_t>(below(random, 40)));
    for (V3d& p : corners) {
      p = V3d(static_cast<double>(below(random, size)), static_cast<double>(below(random, size)), 0);
    }
    const std::vector<CornerTriangle> triangles = triangles_of(corners);
    ASSERT_EQ(triangles.size() + 2, corners.size());
    ASSERT_EQ(triangles, triangles_of(corners));
  }
}

/// How much of the triangles' area is covered twice or outside, as a fraction of the polygon's area.
double excess(const std::vector<V3d>& corners, const std::vector<CornerTriangle>& triangles,
              const V3d& normal) {
  double sum = 0;
  double sum_of_sizes = 0;
  for (const auto& [a, b, c] : triangles) {
    const double area = (corners[b] - corners[a]).cross(corners[c] - corners[a]).dot(normal);
    sum += area;
    sum_of_sizes += std::abs(area);
  }
  return (sum_of_sizes - std::abs(sum)) / std::abs(sum);
}

TEST(TriangulateClipped, DoesNotOverlapInSpiteOfRounding) {
  // Concave polygons in arbitrary planes, cut by the real frustum: bridge edges lie upon each other only
  // roughly.
  lattice::Random random(7);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  const Frustum frustum{.tan_x = 0.4, .tan_y = 0.3, .hither = 1, .yon = 4};
  ClipScratch scratch;
  int cut = 0;
  for (int i = 0; i < 5000; ++i) {
    const int corners = 5 + static_cast<int>(below(random, 40));
    const Polygon flat = i % 3 == 0 ? lattice::random_simple(random, corners, 4 + below(random, 30))
                         : i % 3 == 1
                             ? lattice::random_weakly_simple(random, corners, 3 + below(random, 8), false)
                             : lattice::random_weakly_simple(random, corners, 3 + below(random, 8), true);
    V3d normal(uniform(), uniform(), uniform());
    if (i % 5 == 0)
      normal = V3d(0, 0, 1);  // the side planes then meet it in lines that are not lattice lines
    if (i % 7 == 0) normal.z = 0;
    normal.normalize();
    const V3d across = normal.cross(V3d(uniform(), uniform(), uniform())).normalized();
    const V3d along = normal.cross(across);
    const V3d origin(uniform(), uniform(), 2 + 2 * uniform());
    const double unit = 0.1 + 0.4 * std::abs(uniform());
    std::vector<EyeVertex> polygon;
    for (const lattice::Point& p : flat) {
      const V3d position = origin + across * (unit * static_cast<double>(p.x - 3)) +
                           along * (unit * static_cast<double>(p.y - 3));
      polygon.push_back({position, normal, 0});
    }
    if (clip_to_frustum(polygon, frustum, scratch) != ClipResult::partly) continue;
    std::vector<V3d> positions(polygon.size());
    std::ranges::transform(polygon, positions.begin(), &EyeVertex::position);
    double area = 0;
    for (std::size_t k = 1; k + 1 < positions.size(); ++k) {
      area += (positions[k] - positions[0]).cross(positions[k + 1] - positions[0]).dot(normal);
    }
    if (std::abs(area) < 1e-9) continue;
    ++cut;
    const std::vector<CornerTriangle> triangles = triangles_of(positions, normal);
    ASSERT_EQ(triangles.size() + 2, positions.size());
    // Slivers as wide as the forgiveness, 2^-42 of coordinates up to 4, along edges up to 10 long, are no
    // overlap.
    ASSERT_LT(excess(positions, triangles, normal) * std::abs(area), 1e-9) << "polygon " << i;
    ASSERT_EQ(triangles, reference_triangles_of(positions, normal)) << "polygon " << i;
  }
  EXPECT_GT(cut, 2000);
}

/// The outline of a cog wheel, with four corners to a tooth.
std::vector<V3d> gear(int teeth) {
  std::vector<V3d> corners;
  for (int i = 0; i < 4 * teeth; ++i) {
    const double angle = (i + (i % 2 == 0 ? 0.2 : -0.2)) * std::numbers::pi / (2 * teeth);
    const double radius = i % 4 < 2 ? 1.0 : 0.87;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.25);
  }
  return corners;
}

TEST(TriangulateShapes, CutsACogWheelAsTheReferenceDoes) {
  const std::vector<V3d> corners = gear(36);
  ASSERT_EQ(corners.size(), 144u);
  const std::vector<CornerTriangle> triangles = triangles_of(corners);
  EXPECT_EQ(triangles, reference_triangles_of(corners));
  EXPECT_LT(excess(corners, triangles, k_towards_z), 1e-15);
}

TEST(TriangulateShapes, CutsRandomStarsAsTheReferenceDoes) {
  lattice::Random random(8);
  for (int i = 0; i < 60; ++i) {
    std::vector<V3d> corners;
    const int n = 20 + static_cast<int>(below(random, 200));
    for (int k = 0; k < n; ++k) {
      const double radius = 0.1 + 1e-3 * static_cast<double>(below(random, 1000));
      const double angle = 2 * std::numbers::pi * k / n;
      corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    const std::vector<CornerTriangle> triangles = triangles_of(corners);
    ASSERT_EQ(triangles, reference_triangles_of(corners));
    ASSERT_LT(excess(corners, triangles, k_towards_z), 1e-12);
  }
}

// Polygons so large that a cubic method, or a quadratic one with large factors, would not come back.
class TriangulateLarge : public testing::Test {
 protected:
  static constexpr int k_corners = 100'000;

  static void expect_good(const std::vector<V3d>& corners) {
    const std::vector<CornerTriangle> triangles = triangles_of(corners);
    ASSERT_EQ(triangles.size() + 2, corners.size());
    for (const auto& [a, b, c] : triangles) {
      const auto flat = [&](std::uint32_t i) { return V2d(corners[i].x, corners[i].y); };
      ASSERT_GT(orientation(flat(a), flat(b), flat(c)), 0);
    }
    std::vector<int> uses(corners.size());
    for (const CornerTriangle& t : triangles) {
      for (const std::uint32_t corner : t) ++uses[corner];
    }
    EXPECT_EQ(std::ranges::count(uses, 0), 0);
  }
};

TEST_F(TriangulateLarge, CutsAConvexPolygon) {
  std::vector<V3d> corners;
  for (int i = 0; i < k_corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / k_corners;
    corners.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  expect_good(corners);
}

TEST_F(TriangulateLarge, CutsAStar) {
  std::vector<V3d> corners;
  for (int i = 0; i < k_corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / k_corners;
    const double radius = i % 2 == 0 ? 1 : 0.3;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  expect_good(corners);
}

TEST_F(TriangulateLarge, CutsAComb) {
  std::vector<V3d> corners;
  for (int i = k_corners / 2; i > 0; --i) {
    corners.emplace_back(i, 1000, 0);
    corners.emplace_back(i - 0.5, 1, 0);
  }
  corners.emplace_back(0, 0, 0);
  corners.emplace_back(k_corners / 2, 0, 0);
  expect_good(corners);
}

TEST_F(TriangulateLarge, CutsASpiral) {
  std::vector<V3d> corners;
  const auto add = [&](int i, double offset) {
    const double angle = 0.01 * i;
    const double radius = 1 + angle + offset;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  };
  for (int i = 0; i < k_corners / 2; ++i) add(i, 3);
  for (int i = k_corners / 2 - 1; i >= 0; --i) add(i, 0);
  expect_good(corners);
}

TEST_F(TriangulateLarge, CutsManyCornersOnOneLine) {
  std::vector<V3d> corners;
  corners.reserve(k_corners + 2);
  for (int i = 0; i < k_corners; ++i) corners.emplace_back(i, 0, 0);
  corners.emplace_back(k_corners, 5, 0);
  corners.emplace_back(-1, 5, 0);
  expect_good(corners);
}

}  // namespace
}  // namespace farop
