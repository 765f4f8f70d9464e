// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

#include "scene/plane.h"
#include "scene/surface_builder.h"

namespace farop {
namespace {

void add_polygon(SurfaceBuilder& builder, const std::vector<V3d>& corners) {
  builder.begin_polygon(false);
  for (const V3d& p : corners) builder.add_corner(p);
  builder.end_polygon();
}

TEST(SurfaceBuilder, NeighboursShareTheirVertices) {
  SurfaceBuilder builder;
  add_polygon(builder, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  add_polygon(builder, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const Surface s = builder.take();
  EXPECT_EQ(s.positions.size(), 4u);
  ASSERT_EQ(s.polygons.size(), 2u);
  const PolygonView second = *std::next(s.polygons.begin());
  EXPECT_EQ(std::vector<std::uint32_t>(second.corners.begin(), second.corners.end()),
            (std::vector<std::uint32_t>{0, 2, 3}));
}

TEST(SurfaceBuilder, ZeroAndMinusZeroAreDifferentVertices) {
  SurfaceBuilder builder;
  add_polygon(builder, {{0, 0, 0}, {-0.0, 0, 0}, {1, 1, 0}});
  EXPECT_EQ(builder.take().positions.size(), 3u);
}

// Against the definition: an ordered map over all bits, on surfaces that mix both kinds of corner.
TEST(SurfaceBuilder, NumbersVerticesLikeAPlainMap) {
  std::mt19937 random(7);
  const auto below = [&](unsigned n) { return static_cast<double>(random() % n); };
  for (int round = 0; round < 300; ++round) {
    SurfaceBuilder builder;
    std::map<std::tuple<bool, double, double, double, double>, std::uint32_t> expected;
    std::vector<std::uint32_t> numbers;
    const int kinds = round % 3;  // plain, given, mixed
    const int polygons = 1 + static_cast<int>(random() % 60);
    for (int p = 0; p < polygons; ++p) {
      const bool given = kinds == 1 || (kinds == 2 && random() % 2 == 0);
      builder.begin_polygon(given);
      for (int c = 0; c < 3; ++c) {
        const V3d position(below(4), below(4), below(2));
        const V3d normal(0, 0, below(2));
        if (given) {
          builder.add_corner(position, normal);
        } else {
          builder.add_corner(position);
        }
        const auto key = std::tuple(given, position.x, position.y, position.z, given ? normal.z : -1.0);
        numbers.push_back(
            expected.try_emplace(key, static_cast<std::uint32_t>(expected.size())).first->second);
      }
      builder.end_polygon();
    }
    const Surface s = builder.take();
    ASSERT_EQ(s.positions.size(), expected.size());
    ASSERT_EQ(s.normals.size(), s.normals.empty() ? 0u : expected.size());
    std::vector<std::uint32_t> got;
    for (const PolygonView polygon : s.polygons) {
      for (const std::uint32_t v : polygon.corners) got.push_back(v);
    }
    ASSERT_EQ(got, numbers) << "round " << round;
  }
}

// Many polygons at a time, and surfaces put together from pieces, against corner by corner.
TEST(SurfaceBuilder, TakesPolygonsAndPiecesAsIfCornerByCorner) {
  std::mt19937 random(11);
  SurfaceBuilder one_by_one, many, piece, pieces;
  for (int round = 0; round < 100; ++round) {
    const auto grid = 2 + random() % 30;
    const auto coordinate = [&] { return static_cast<double>(random() % grid) / 8; };
    const auto kinds = random() % 3;  // p, pp, both
    for (auto runs = 1 + random() % 6; runs > 0; --runs) {
      const bool given = kinds == 2 ? random() % 2 != 0 : kinds == 1;
      std::vector<double> numbers;
      std::vector<std::uint32_t> counts;
      for (auto polygons = random() % 200; polygons > 0; --polygons) {
        counts.push_back(3 + random() % 4);
        one_by_one.begin_polygon(given);
        for (std::uint32_t i = 0; i < counts.back(); ++i) {
          const V3d position(coordinate(), coordinate(), -coordinate());
          const V3d normal(0, given && random() % 2 != 0 ? 0.5 : 0, 1);
          given ? one_by_one.add_corner(position, normal) : one_by_one.add_corner(position);
          numbers.insert(numbers.end(), {position.x, position.y, position.z});
          if (given) numbers.insert(numbers.end(), {normal.x, normal.y, normal.z});
        }
        one_by_one.end_polygon();
      }
      many.add_polygons(numbers, counts, given);
      piece.add_polygons(numbers, counts, given);
      if (random() % 4 == 0) {
        const Sphere sphere{{coordinate(), 0, 0}, 1, false};
        one_by_one.add(sphere), many.add(sphere), piece.add(sphere);
      }
      if (random() % 2 == 0) pieces.append(piece.take());
    }
    pieces.append(piece.take());
    const Surface expected = one_by_one.take();
    ASSERT_TRUE(many.take() == expected);
    ASSERT_TRUE(pieces.take() == expected);
  }
}

TEST(SurfaceBuilder, StartsAfreshAfterTake) {
  SurfaceBuilder builder;
  add_polygon(builder, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  const Surface first = builder.take();
  add_polygon(builder, {{1, 0, 0}, {0, 0, 0}, {0, 1, 0}});
  const Surface second = builder.take();
  EXPECT_EQ(second.positions.front(), V3d(1, 0, 0));
  EXPECT_EQ(second.positions.size(), 3u);
  EXPECT_TRUE(builder.empty());
}

TEST(PolygonList, CancelledPolygonsLeaveNoTrace) {
  PolygonRecorder recorder;
  recorder.begin_polygon(true);
  recorder.add_corner(5);
  recorder.cancel_polygon();
  recorder.begin_polygon(false);
  for (std::uint32_t i = 0; i < 4; ++i) recorder.add_corner(i);
  recorder.end_polygon();
  const PolygonList list = recorder.take();
  EXPECT_TRUE(recorder.empty());
  ASSERT_EQ(list.size(), 1u);
  const PolygonView p = *list.begin();
  EXPECT_FALSE(p.has_given_normals);
  EXPECT_EQ(p.corners.size(), 4u);
  EXPECT_EQ(std::next(list.begin()), list.end());
}

const std::vector<std::uint32_t> k_ring = {0, 1, 2, 3, 4};

TEST(PlaneNormal, PointsToTheSideFromWhichTheCornersRunCounterClockwise) {
  const std::vector<V3d> concave_at_first_corner = {{1, 1, 7}, {0, 4, 7}, {-4, 0, 7}, {4, 0, 7}};
  const auto n = plane_normal(concave_at_first_corner, std::span(k_ring).first(4));
  ASSERT_TRUE(n);
  EXPECT_NEAR((*n - V3d(0, 0, 1)).length(), 0, 1e-15);
}

TEST(PlaneNormal, SurvivesADegenerateFirstCorner) {
  const std::vector<V3d> p = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, -3}};
  const auto n = plane_normal(p, k_ring);
  ASSERT_TRUE(n);
  EXPECT_NEAR((*n - V3d(0, 1, 0)).length(), 0, 1e-15);
}

TEST(PlaneNormal, IsMissingExactlyForDegeneratePolygonsWhateverTheirPlaceAndSize) {
  for (const double scale : {1e-200, 1e-30, 1.0, 1e30, 1e150}) {
    for (const double shift : {0.0, 1e3}) {
      const auto at = [&](double x, double y) {
        return V3d(scale * (x + shift), scale * (y + shift), scale * shift);
      };
      const std::vector<V3d> thin = {at(0, 0), at(1, 0), at(2, 1e-9), at(1, 1e-9)};
      const std::vector<V3d> line = {at(0, 0), at(1, 1), at(2, 2), at(3, 3)};
      const std::vector<V3d> point = {at(1, 1), at(1, 1), at(1, 1), at(1, 1)};
      EXPECT_TRUE(plane_normal(thin, std::span(k_ring).first(4))) << scale << " " << shift;
      EXPECT_FALSE(plane_normal(line, std::span(k_ring).first(4))) << scale << " " << shift;
      EXPECT_FALSE(plane_normal(point, std::span(k_ring).first(4))) << scale << " " << shift;
    }
  }
}

TEST(AverageNormals, WeighEveryPolygonOfAVertexEquallyAndSkipDegenerateOnes) {
  SurfaceBuilder builder;
  add_polygon(builder, {{0, 0, 0}, {5, 0, 0}, {0, 5, 0}});  // +z, large
  add_polygon(builder, {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}});  // +x, small
  add_polygon(builder, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}});  // no area
  Surface s = builder.take();
  average_normals(s);
  EXPECT_NEAR((s.averaged_normals[0] - V3d(1, 0, 1).normalized()).length(), 0, 1e-15);
  EXPECT_NEAR((s.averaged_normals[1] - V3d(0, 0, 1)).length(), 0, 1e-15);
}

TEST(AverageNormals, OppositePolygonsSumToZero) {
  SurfaceBuilder builder;
  add_polygon(builder, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  add_polygon(builder, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}});
  Surface s = builder.take();
  average_normals(s);
  for (const V3d& n : s.averaged_normals) EXPECT_EQ(n, V3d(0, 0, 0));
}

TEST(Surface, AveragedNormalsCountWhereTheyMayHaveBeenGiven) {
  SurfaceBuilder builder;
  add_polygon(builder, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  Surface a = builder.take();
  Surface b = a;
  average_normals(b);
  EXPECT_EQ(a, b) << "NFF's are made when they are asked for";
  a.normal_rule = b.normal_rule = NormalRule::sipp;
  EXPECT_FALSE(a == b);
  average_normals(a);
  EXPECT_EQ(a, b);
  a.averaged_normals[1] = V3d(0, 1, 0);
  EXPECT_FALSE(a == b);
}

}  // namespace
}  // namespace farop
