// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "unit/geometry/lattice_polygons.h"

namespace farop {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
/// Planes that cut nothing in the tests that use it.
constexpr Frustum k_wide{.tan_x = 1e9, .tan_y = 1e9, .hither = 1e-9, .yon = k_infinity};

using EyePolygon = std::vector<EyeVertex>;

EyePolygon polygon_of(const std::vector<V3d>& positions, const V3d& normal = V3d(0, 0, -1)) {
  EyePolygon polygon;
  for (const V3d& p : positions) polygon.push_back({p, normal, static_cast<std::uint32_t>(polygon.size())});
  return polygon;
}

ClipResult clip(EyePolygon& polygon, const Frustum& frustum) {
  static ClipScratch scratch;
  return clip_to_frustum(polygon, frustum, scratch);
}

/// What is left of a polygon; nothing if it is totally clipped.
EyePolygon clipped(EyePolygon polygon, const Frustum& frustum) {
  if (clip(polygon, frustum) == ClipResult::outside) return {};
  return polygon;
}

std::vector<V3d> positions_of(const EyePolygon& polygon) {
  std::vector<V3d> positions;
  for (const EyeVertex& v : polygon) positions.push_back(v.position);
  return positions;
}

/// Newell's sum: twice the area, along the normal.
V3d doubled_vector_area(const EyePolygon& polygon) {
  V3d sum(0);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const V3d& origin = polygon[0].position;
    sum += (polygon[i].position - origin).cross(polygon[i + 1].position - origin);
  }
  return sum;
}

bool same_bits(const EyeVertex& a, const EyeVertex& b) {
  return a.position == b.position && a.normal == b.normal && a.source == b.source && a.texture == b.texture;
}

bool is_inside(const V3d& p, const Frustum& f) {
  return p.z >= f.hither && p.z <= f.yon && std::abs(p.x) <= p.z * f.tan_x && std::abs(p.y) <= p.z * f.tan_y;
}

/// Uniform in -1 .. 1.
double uniform(lattice::Random& random) {
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1;
}
V3d uniform_vector(lattice::Random& random) {
  return {uniform(random), uniform(random), uniform(random)};
}

/// A planar polygon, convex or concave, about `extent` large, in and around k_frustum.
EyePolygon random_polygon(lattice::Random& random, double extent = 4) {
  const int corners = 3 + static_cast<int>(lattice::below(random, 20));
  const std::int64_t size = 3 + lattice::below(random, 20);
  const lattice::Polygon flat = lattice::random_simple(random, corners, size);
  const V3d across = uniform_vector(random);
  const V3d along = uniform_vector(random);
  const V3d origin = uniform_vector(random) + V3d(0, 0, 1.5);
  EyePolygon polygon;
  for (const lattice::Point& p : flat) {
    const double u = extent * (static_cast<double>(p.x) / static_cast<double>(size) - 0.5);
    const double v = extent * (static_cast<double>(p.y) / static_cast<double>(size) - 0.5);
    polygon.push_back({origin + across * u + along * v, uniform_vector(random).normalized(),
                       static_cast<std::uint32_t>(polygon.size())});
  }
  return polygon;
}

constexpr Frustum k_frustum{.tan_x = 0.7, .tan_y = 0.4, .hither = 0.5, .yon = 2.5};

TEST(Clip, LeavesAnInsidePolygonBitIdentical) {
  EyePolygon polygon = polygon_of({{0, 0, 1}, {0.3, 0, 1}, {0.1, 0.2, 1.5}}, V3d(0.6, 0, -0.8));
  const EyePolygon before = polygon;
  const EyeVertex* storage = polygon.data();
  EXPECT_EQ(clip(polygon, k_frustum), ClipResult::inside);
  EXPECT_TRUE(std::ranges::equal(polygon, before, same_bits));
  EXPECT_EQ(polygon.data(), storage) << "an inside polygon is not even copied";
}

TEST(Clip, TakesAVertexOnAPlaneAsInside) {
  const Frustum frustum{.tan_x = 0.5, .tan_y = 0.25, .hither = 1, .yon = 4};
  for (const std::vector<V3d>& touching : {std::vector<V3d>{{0, 0, 1}, {0.1, 0, 1}, {0, 0.1, 1}},
                                           {{0, 0, 4}, {0.1, 0, 4}, {0, 0.1, 4}},
                                           {{-1, 0, 2}, {0, 0, 2}, {-1, 0.1, 2}},
                                           {{1, 0, 2}, {0, 0, 2}, {1, 0.1, 2}},
                                           {{0, -0.5, 2}, {0, 0, 2}, {0.1, -0.5, 2}},
                                           {{0, 0.5, 2}, {0, 0, 2}, {0.1, 0.5, 2}}}) {
    EyePolygon polygon = polygon_of(touching);
    EXPECT_EQ(clip(polygon, frustum), ClipResult::inside);
  }
}

TEST(Clip, DropsWhatLiesBeyondEachPlane) {
  for (const V3d& center : {V3d(0, 0, 0.2), V3d(0, 0, 3), V3d(-3, 0, 1), V3d(3, 0, 1), V3d(0, -3, 1),
                            V3d(0, 3, 1), V3d(0, 0, -1)}) {
    EyePolygon polygon = polygon_of({center, center + V3d(0.1, 0, 0), center + V3d(0, 0.1, 0)});
    EXPECT_EQ(clip(polygon, k_frustum), ClipResult::outside)
        << center.x << ' ' << center.y << ' ' << center.z;
  }
}

TEST(Clip, DropsAPolygonThatPassesACornerOfTheWindow) {
  // No plane has all of it on the far side.
  EyePolygon polygon = polygon_of({{2, 0, 1}, {0, 2, 1}, {2, 2, 1}});
  EXPECT_EQ(clip(polygon, k_frustum), ClipResult::outside);
}

TEST(Clip, DropsAPolygonThatOnlyTouchesAPlane) {
  const Frustum frustum{.tan_x = 1, .tan_y = 1, .hither = 1, .yon = 4};
  EyePolygon corner = polygon_of({{0, 0, 1}, {0.1, 0, 0.5}, {0, 0.1, 0.5}});
  EXPECT_EQ(clip(corner, frustum), ClipResult::outside);
  EyePolygon edge = polygon_of({{0, 0, 1}, {0.1, 0, 1}, {0, 0.1, 0.5}});
  EXPECT_EQ(clip(edge, frustum), ClipResult::outside);
  EyePolygon edge_of_repeated_corners =
      polygon_of({{0, 0, 1}, {0, 0, 1}, {0.1, 0, 1}, {0.1, 0, 1}, {0, 0.1, 0.5}});
  EXPECT_EQ(clip(edge_of_repeated_corners, frustum), ClipResult::outside);
}

TEST(Clip, DoesNotRepeatAVertexOnAPlane) {
  EyePolygon polygon = polygon_of({{0, 0, 1}, {1, 0, 0.5}, {2, 0, 1}, {1, 0, 3}}, V3d(0, 1, 0));
  const Frustum frustum{.tan_x = 8, .tan_y = 8, .hither = 1, .yon = 8};
  EXPECT_EQ(clip(polygon, frustum), ClipResult::partly);
  EXPECT_EQ(positions_of(polygon), (std::vector<V3d>{{0, 0, 1}, {2, 0, 1}, {1, 0, 3}}));
}

TEST(Clip, CutsASquareAtTheHitherPlane) {
  EyePolygon polygon = polygon_of({{-1, 0, 0}, {1, 0, 0}, {1, 0, 4}, {-1, 0, 4}}, V3d(0, 1, 0));
  const Frustum frustum{.tan_x = 8, .tan_y = 8, .hither = 1, .yon = 8};
  EXPECT_EQ(clip(polygon, frustum), ClipResult::partly);
  EXPECT_EQ(positions_of(polygon), (std::vector<V3d>{{-1, 0, 1}, {1, 0, 1}, {1, 0, 4}, {-1, 0, 4}}));
  EXPECT_EQ(polygon[0].source, k_clip_made);
  EXPECT_EQ(polygon[1].source, k_clip_made);
  EXPECT_EQ(polygon[2].source, 2u);
  EXPECT_EQ(polygon[3].source, 3u);
}

TEST(Clip, CutsATriangleThatCoversTheWindowToTheWindow) {
  const Frustum frustum{.tan_x = 0.5, .tan_y = 0.25, .hither = 1, .yon = 8};
  const EyePolygon window = clipped(polygon_of({{-100, -100, 4}, {100, -100, 4}, {0, 100, 4}}), frustum);
  EXPECT_EQ(window.size(), 4u);
  const std::set<std::tuple<double, double, double>> expected{{-2, -1, 4}, {2, -1, 4}, {2, 1, 4}, {-2, 1, 4}};
  std::set<std::tuple<double, double, double>> corners;
  for (const V3d& p : positions_of(window)) corners.emplace(p.x, p.y, p.z);
  EXPECT_EQ(corners, expected);
}

TEST(Clip, LeavesBridgesBetweenThePartsOfAConcavePolygon) {
  // A letter U whose back lies before the hither plane: two prongs are left, joined by two edges upon each
  // other.
  const Frustum frustum{.tan_x = 9, .tan_y = 9, .hither = 2, .yon = 9};
  const EyePolygon prongs = clipped(
      polygon_of({{0, 0, 1}, {3, 0, 1}, {3, 0, 4}, {2, 0, 4}, {2, 0, 1.5}, {1, 0, 1.5}, {1, 0, 4}, {0, 0, 4}},
                 V3d(0, 1, 0)),
      frustum);
  EXPECT_EQ(positions_of(prongs),
            (std::vector<V3d>{
                {0, 0, 2}, {3, 0, 2}, {3, 0, 4}, {2, 0, 4}, {2, 0, 2}, {1, 0, 2}, {1, 0, 4}, {0, 0, 4}}));
}

TEST(Clip, KnowsNoYonAtInfinity) {
  Frustum frustum = k_frustum;
  frustum.yon = k_infinity;
  EyePolygon far = polygon_of({{0, 0, 1e6}, {1, 0, 1e6}, {0, 1, 1e30}});
  EXPECT_EQ(clip(far, frustum), ClipResult::inside);
  EyePolygon cut = polygon_of({{0, 0, 0.1}, {1e30, 0, 1e31}, {0, 1e30, 1e31}});
  EXPECT_EQ(clip(cut, frustum), ClipResult::partly);
  for (const EyeVertex& v : cut) EXPECT_TRUE(is_inside(v.position, frustum));
}

TEST(Clip, KeepsTheNearEndOfAVeryLongEdge) {
  // The cut is 5 units to the right, although the edge starts 1e30 away.
  const Frustum frustum{.tan_x = 100, .tan_y = 100, .hither = 1, .yon = k_infinity};
  const EyePolygon rest = clipped(polygon_of({{5, 0, 0.5}, {5, 0, 1e30}, {5, 1, 1e30}}), frustum);
  ASSERT_EQ(rest.size(), 4u);
  for (const std::size_t i : {0, 1}) {
    EXPECT_EQ(rest[i].position.x, 5);
    EXPECT_EQ(rest[i].position.z, 1);
  }
  const EyePolygon sideways =
      clipped(polygon_of({{5, 0, 0.5}, {1e30, 0, 1e30}, {1e30, 1e29, 1e30}}), frustum);
  ASSERT_FALSE(sideways.empty());
  EXPECT_NEAR(sideways[0].position.x, 5.5, 1e-12);
}

TEST(Clip, TurnsOppositeNormalsIntoAUnitNormal) {
  EyePolygon polygon = polygon_of({{0, 0, 0}, {0, 0, 2}, {0.1, 0, 2}}, V3d(0, 1, 0));
  polygon[0].normal = V3d(0, -1, 0);
  const Frustum frustum{.tan_x = 1, .tan_y = 1, .hither = 1, .yon = 8};
  EXPECT_EQ(clip(polygon, frustum), ClipResult::partly);
  for (const EyeVertex& v : polygon) EXPECT_EQ(v.normal, V3d(0, 1, 0));
}

TEST(ClipRandom, LeavesNothingOutsideNotByTheLastBit) {
  lattice::Random random(1);
  std::array<int, 3> results{};
  for (int i = 0; i < 30000; ++i) {
    EyePolygon polygon = random_polygon(random, i % 4 == 0 ? 0.3 : 4);
    const EyePolygon before = polygon;
    const ClipResult result = clip(polygon, k_frustum);
    ++results[static_cast<std::size_t>(result)];
    const bool was_inside =
        std::ranges::all_of(before, [](const EyeVertex& v) { return is_inside(v.position, k_frustum); });
    ASSERT_EQ(result == ClipResult::inside, was_inside);
    if (result == ClipResult::outside) continue;
    for (const EyeVertex& v : polygon) {
      ASSERT_TRUE(is_inside(v.position, k_frustum));
      ASSERT_NEAR(v.normal.length(), 1, 1e-14);
    }
    EyePolygon again = polygon;
    ASSERT_EQ(clip(again, k_frustum), ClipResult::inside);
  }
  for (const int count : results) EXPECT_GT(count, 300);
}

TEST(ClipRandom, KeepsStoredCornersAndTheirOrder) {
  lattice::Random random(2);
  for (int i = 0; i < 10000; ++i) {
    const EyePolygon before = random_polygon(random);
    const EyePolygon after = clipped(before, k_frustum);
    std::vector<std::uint32_t> kept;
    for (const EyeVertex& v : after) {
      if (v.source == k_clip_made) continue;
      kept.push_back(v.source);
      ASSERT_TRUE(same_bits(v, before[v.source]));
    }
    if (after.empty()) continue;
    std::vector<std::uint32_t> expected;
    for (const EyeVertex& v : before) {
      if (is_inside(v.position, k_frustum)) expected.push_back(v.source);
    }
    ASSERT_EQ(kept.size(), expected.size());
    ASSERT_TRUE(std::ranges::is_permutation(kept, expected));
    ASSERT_TRUE(std::ranges::is_sorted(kept) || kept.front() > kept.back());
  }
}

/// Reflection in the plane through the origin with the given normal.
EyePolygon reflected(EyePolygon polygon, const V3d& normal) {
  const V3d n = normal.normalized();
  for (EyeVertex& v : polygon) v.position -= n * (2 * v.position.dot(n));
  return polygon;
}

TEST(ClipRandom, KeepsAreaInsidePlusOutside) {
  lattice::Random random(3);
  const auto area = [](const EyePolygon& p) { return doubled_vector_area(p).length(); };
  int cut = 0;
  for (int i = 0; i < 20000; ++i) {
    EyePolygon polygon = random_polygon(random);
    for (EyeVertex& v : polygon)
      v.position.z += 8;  // before the eye as a whole: every other plane is far away
    double inside = 0;
    double outside = 0;
    if (i % 3 == 0) {
      Frustum before = k_wide;
      Frustum behind = k_wide;
      before.yon = behind.hither = 8 + uniform(random);
      inside = area(clipped(polygon, before));
      outside = area(clipped(polygon, behind));
    } else {
      // What is outside one side plane is inside it after reflection.
      Frustum frustum = k_wide;
      const double tangent = 0.02 + 0.2 * std::abs(uniform(random));
      const bool is_x = i % 3 == 1;
      (is_x ? frustum.tan_x : frustum.tan_y) = tangent;
      const double sign = i % 2 == 0 ? 1 : -1;
      const V3d plane = is_x ? V3d(sign, 0, -tangent) : V3d(0, sign, -tangent);
      // The opposite side must stay away: move the polygon over to this one.
      for (EyeVertex& v : polygon) v.position += (is_x ? V3d(sign, 0, 0) : V3d(0, sign, 0)) * (8 * tangent);
      const auto opposite_cuts = [&](const EyePolygon& p) {
        return std::ranges::any_of(p, [&](const EyeVertex& v) {
          return sign * (is_x ? v.position.x : v.position.y) < -v.position.z * tangent;
        });
      };
      const EyePolygon mirror_image = reflected(polygon, plane);
      if (opposite_cuts(polygon) || opposite_cuts(mirror_image)) continue;
      inside = area(clipped(polygon, frustum));
      outside = area(clipped(mirror_image, frustum));
    }
    if (inside > 0 && outside > 0) ++cut;
    // Coordinates are below 16 and edges below 12 long: 1e-13 is a few hundred roundings.
    ASSERT_NEAR(inside + outside, area(polygon), 1e-13 * 16 * 12) << i;
  }
  EXPECT_GT(cut, 4000);
}

TEST(ClipRandom, CutsASharedEdgeAtTheSamePointsForAllItsPolygons) {
  lattice::Random random(4);
  using Bits = std::tuple<double, double, double>;
  int edges_cut = 0;
  for (int i = 0; i < 10000; ++i) {
    const V3d a = uniform_vector(random) * 2 + V3d(0, 0, 1.5);
    const V3d b = uniform_vector(random) * 2 + V3d(0, 0, 1.5);
    bool has_inner_part = false;
    for (int k = 1; k < 50; ++k) {
      const V3d p = a + (b - a) * (k / 50.0);
      has_inner_part = has_inner_part || (is_inside(p * 1.01, k_frustum) && is_inside(p * 0.99, k_frustum) &&
                                          std::abs(p.x) < 0.69 * p.z && std::abs(p.y) < 0.39 * p.z);
    }
    if (!has_inner_part || (is_inside(a, k_frustum) && is_inside(b, k_frustum))) continue;
    ++edges_cut;
    // Triangles around the edge, running either way, with the edge first, second or last: what they have in
    // common are the two ends of what is left of the edge.
    std::optional<std::set<Bits>> common;
    for (int k = 0; k < 6; ++k) {
      std::vector<V3d> corners{a, b, uniform_vector(random) * 3};
      if (k % 2 == 1) std::swap(corners[0], corners[1]);
      std::rotate(corners.begin(), corners.begin() + k / 2, corners.end());
      std::set<Bits> found;
      for (const V3d& p : positions_of(clipped(polygon_of(corners), k_frustum))) found.emplace(p.x, p.y, p.z);
      if (!common) {
        common = found;
      } else {
        std::erase_if(*common, [&](const Bits& bits) { return !found.contains(bits); });
      }
    }
    ASSERT_EQ(common->size(), 2u) << i;
  }
  EXPECT_GT(edges_cut, 500);
}

TEST(ClipRandom, InterpolatesNormalsLinearlyOverTheWholePolygon) {
  // Over a triangle an attribute is linear in the position, also for corners that two planes made.
  lattice::Random random(5);
  int made = 0;
  for (int i = 0; i < 10000; ++i) {
    EyePolygon triangle =
        polygon_of({uniform_vector(random) * 2 + V3d(0, 0, 1.5), uniform_vector(random) * 2 + V3d(0, 0, 1.5),
                    uniform_vector(random) * 2 + V3d(0, 0, 1.5)});
    for (EyeVertex& v : triangle) v.normal = uniform_vector(random).normalized();
    const V3d plane = doubled_vector_area(triangle);
    if (plane.length() < 0.1) continue;
    for (const EyeVertex& v : clipped(triangle, k_frustum)) {
      V3d expected(0);
      for (std::size_t k = 0; k < 3; ++k) {
        const V3d& b = triangle[(k + 1) % 3].position;
        const V3d& c = triangle[(k + 2) % 3].position;
        expected +=
            triangle[k].normal * ((b - v.position).cross(c - v.position).dot(plane) / plane.length2());
      }
      if (expected.length() < 1e-3) continue;  // nearly opposite normals magnify rounding
      ASSERT_LT((v.normal - expected.normalized()).length(), 1e-9);
      if (v.source == k_clip_made) ++made;
    }
  }
  EXPECT_GT(made, 5000);
}

TEST(ClipRandom, InterpolatesTextureCoordinatesWithThePositions) {
  // Texture coordinates that are an affine map of the position stay that, also where two planes cut.
  lattice::Random random(6);
  M44d map;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 3; ++column) map[row][column] = uniform(random);
  }
  int made = 0;
  for (int i = 0; i < 3000; ++i) {
    EyePolygon polygon = random_polygon(random);
    for (EyeVertex& v : polygon) v.texture = v.position * map;
    for (const EyeVertex& v : clipped(polygon, k_frustum)) {
      ASSERT_LT((v.texture - v.position * map).length(), 1e-9);
      if (v.source == k_clip_made) ++made;
    }
  }
  EXPECT_GT(made, 3000);
}

TEST(ClipRandom, StaysFiniteForHugeAndTinyCoordinates) {
  lattice::Random random(6);
  for (int i = 0; i < 20000; ++i) {
    const auto any_size = [&] { return uniform(random) * std::pow(10, 30 * uniform(random)); };
    EyePolygon polygon = polygon_of({});
    for (std::uint32_t k = 0; k < 5; ++k) {
      polygon.push_back({V3d(any_size(), any_size(), any_size()), uniform_vector(random).normalized(), k});
    }
    Frustum frustum = k_frustum;
    frustum.hither = std::pow(10, 25 * uniform(random));
    frustum.yon = i % 2 == 0 ? k_infinity : frustum.hither * (1 + 1e6 * std::abs(uniform(random)));
    if (clip(polygon, frustum) != ClipResult::partly) continue;
    for (const EyeVertex& v : polygon) {
      ASSERT_TRUE(is_inside(v.position, frustum));
      ASSERT_NEAR(v.normal.length(), 1, 1e-14);
    }
  }
}

TEST(ClipRandom, DoesNotDependOnTheFirstCorner) {
  lattice::Random random(7);
  for (int i = 0; i < 5000; ++i) {
    const EyePolygon polygon = random_polygon(random);
    EyePolygon rotated = polygon;
    std::rotate(rotated.begin(), rotated.begin() + 1, rotated.end());
    EyePolygon first = clipped(polygon, k_frustum);
    const EyePolygon second = clipped(rotated, k_frustum);
    ASSERT_EQ(first.size(), second.size());
    if (first.empty()) continue;
    bool same = false;
    for (std::size_t shift = 0; shift < first.size() && !same; ++shift) {
      same = std::ranges::equal(first, second, same_bits);
      std::rotate(first.begin(), first.begin() + 1, first.end());
    }
    ASSERT_TRUE(same);
  }
}

}  // namespace
}  // namespace farop
