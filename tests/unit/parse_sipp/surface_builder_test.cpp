// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "parse_sipp/sipp_surface_builder.h"
#include "scene/plane.h"

namespace farop::sipp {
namespace {

void push_triangle(SurfaceBuilder& builder, const V3d& a, const V3d& b, const V3d& c) {
  for (const V3d& p : {a, b, c}) builder.push_vertex({p, p, {}});
  builder.push_polygon();
}

std::vector<std::vector<std::uint32_t>> polygons_of(const Surface& surface) {
  std::vector<std::vector<std::uint32_t>> out;
  for (const PolygonView p : surface.polygons) out.emplace_back(p.corners.begin(), p.corners.end());
  return out;
}

TEST(SippSurfaceBuilder, ListsThePolygonPushedLastFirst) {
  SurfaceBuilder builder;
  push_triangle(builder, V3d(0, 0, 0), V3d(1, 0, 0), V3d(0, 1, 0));
  push_triangle(builder, V3d(1, 0, 0), V3d(1, 1, 0), V3d(0, 1, 0));
  const auto surface = builder.create(nullptr);
  EXPECT_EQ(polygons_of(*surface), (std::vector<std::vector<std::uint32_t>>{{1, 3, 2}, {0, 1, 2}}));
  EXPECT_EQ(surface->normal_rule, NormalRule::sipp);
  EXPECT_EQ(surface->positions.size(), 4u);
  EXPECT_EQ(surface->textures.size(), 4u);
}

TEST(SippSurfaceBuilder, CreatesNothingWithoutPolygonsAndKeepsOpenVertices) {
  SurfaceBuilder builder;
  EXPECT_EQ(builder.create(nullptr), nullptr);
  builder.push_vertex({V3d(0, 0, 0), V3d(0, 0, 0), {}});
  builder.push_vertex({V3d(1, 0, 0), V3d(0, 0, 0), {}});
  EXPECT_EQ(builder.create(nullptr), nullptr);
  builder.push_vertex({V3d(0, 1, 0), V3d(0, 0, 0), {}});
  EXPECT_TRUE(builder.push_polygon());
  builder.push_vertex({V3d(5, 0, 0), V3d(0, 0, 0), {}});  // left open
  ASSERT_NE(builder.create(nullptr), nullptr);
  builder.push_vertex({V3d(6, 0, 0), V3d(0, 0, 0), {}});
  builder.push_vertex({V3d(5, 1, 0), V3d(0, 0, 0), {}});
  builder.push_polygon();
  const auto second = builder.create(nullptr);
  EXPECT_EQ(second->positions, (std::vector<V3d>{V3d(5, 0, 0), V3d(6, 0, 0), V3d(5, 1, 0)}));
}

TEST(SippSurfaceBuilder, DropsPolygonsOfFewerThanThreeVertices) {
  SurfaceBuilder builder;
  EXPECT_FALSE(builder.push_polygon());
  builder.push_vertex({V3d(0, 0, 0), V3d(0, 0, 0), {}});
  builder.push_vertex({V3d(1, 0, 0), V3d(0, 0, 0), {}});
  EXPECT_FALSE(builder.push_polygon());
  EXPECT_TRUE(builder.empty());
  push_triangle(builder, V3d(0, 0, 0), V3d(1, 0, 0), V3d(0, 1, 0));
  builder.clear();
  EXPECT_EQ(builder.create(nullptr), nullptr);
}

TEST(SippSurfaceBuilder, TakesTheToleranceFromTheFirstVertexThatLiesElsewhere) {
  // 1e-10 times 1000: whatever comes within 1e-7 of a vertex is that vertex.
  SurfaceBuilder builder;
  const V3d a(0, 0, 0), b(1000, 0, 0), c(0, 1, 0);
  push_triangle(builder, a, a, b);
  push_triangle(builder, b + V3d(0.9e-7, -0.9e-7, 0.9e-7), a - V3d(0.9e-7, 0, 0), c);
  EXPECT_EQ(builder.vertex_count(), 3u);
  push_triangle(builder, b + V3d(1.1e-7, 0, 0), a, c + V3d(0, 0, -1.1e-7));
  EXPECT_EQ(builder.vertex_count(), 5u);
  // Frozen: a distance that comes later changes nothing.
  push_triangle(builder, V3d(1e9, 0, 0), V3d(1e9 + 1e-6, 0, 0), c);
  EXPECT_EQ(builder.vertex_count(), 7u);
}

TEST(SippSurfaceBuilder, TheNewToleranceAppliesToThePushThatMadeIt) {
  // The second vertex lies 1e-12 away: d = 1e-22, so it is another one.
  SurfaceBuilder builder;
  builder.push_vertex({V3d(0, 0, 0), V3d(0, 0, 0), {}});
  builder.push_vertex({V3d(1e-12, 0, 0), V3d(0, 0, 0), {}});
  EXPECT_EQ(builder.vertex_count(), 2u);
}

TEST(SippSurfaceBuilder, KeepsVerticesOfOtherTextureOrNormalApart) {
  SurfaceBuilder builder;
  const V3d p(1, 2, 3);
  builder.push_vertex({p, V3d(0, 0, 0), {}});
  builder.push_vertex({p, V3d(0, 0.5, 0), {}});
  builder.push_vertex({p, V3d(0, 0, 0), {}});
  EXPECT_EQ(builder.vertex_count(), 2u);
  builder.push_vertex({p, V3d(0, 0, 0), V3d(0, 0, 1)});  // with its own normal: never merged with the others
  builder.push_vertex({p, V3d(0, 0, 0), V3d(0, 0, 2)});
  builder.push_vertex({p, V3d(0, 0, 0), V3d(0, 0, 1)});
  EXPECT_EQ(builder.vertex_count(), 4u);
}

TEST(SippSurfaceBuilder, AveragesOrKeepsNormals) {
  // Two squares in a right angle; one corner has a normal of its own.
  SurfaceBuilder builder;
  const V3d own(3, 0, 4);
  const auto push = [&](const V3d& p) { builder.push_vertex({p, V3d(0, 0, 0), {}}); };
  push(V3d(0, 0, 0)), push(V3d(0, -1, 0)), push(V3d(1, -1, 0)), push(V3d(1, 0, 0));
  builder.push_polygon();
  push(V3d(0, 0, 0)), push(V3d(1, 0, 0)), push(V3d(1, 0, -1));
  builder.push_vertex({V3d(0, 0, -1), V3d(0, 0, 0), own});
  builder.push_polygon();
  const auto surface = builder.create(nullptr);
  const std::vector<V3d>& n = surface->averaged_normals;
  ASSERT_EQ(n.size(), 6u);
  EXPECT_NEAR((n[0] - V3d(0, 1, 1).normalized()).length(), 0, 1e-15);
  EXPECT_EQ(n[1], V3d(0, 0, 1));
  EXPECT_EQ(n[4], V3d(0, 1, 0));
  EXPECT_NEAR((n[5] - own.normalized()).length(), 0, 1e-15);
}

TEST(SippSurfaceBuilder, WhatIsNotFiniteJoinsNothing) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  SurfaceBuilder builder;
  for (int i = 0; i < 3; ++i) builder.push_vertex({V3d(nan, 0, 0), V3d(0, 0, 0), {}});
  for (int i = 0; i < 3; ++i) builder.push_vertex({V3d(inf, 0, 0), V3d(0, 0, 0), {}});
  builder.push_vertex({V3d(1, 0, 0), V3d(0, 0, 0), {}});
  builder.push_vertex({V3d(1, 0, 0), V3d(0, 0, 0), {}});
  builder.push_vertex({V3d(2, 0, 0), V3d(0, 0, 0), {}});
  EXPECT_EQ(builder.vertex_count(), 8u);
  builder.push_polygon();
  EXPECT_NE(builder.create(nullptr), nullptr);
}

/// The rule of merging, word by word, without any search structure.
class Reference {
 public:
  std::size_t push(const Vertex& v) {
    if (!stored_.empty() && !frozen_) {
      const V3d d = v.position - stored_[0].position;
      tolerance_ = 1e-10 * std::hypot(d.x, d.y, d.z);
      frozen_ = tolerance_ != 0;
      if (!frozen_) tolerance_ = 1e-10;
    }
    for (std::size_t i = 0; i < stored_.size(); ++i) {
      if (same(v, stored_[i])) return i;
    }
    stored_.push_back(v);
    return stored_.size() - 1;
  }

 private:
  bool same(const Vertex& a, const Vertex& b) const {
    if (a.normal.has_value() != b.normal.has_value()) return false;
    const auto close = [&](const V3d& p, const V3d& q) {
      for (int i = 0; i < 3; ++i) {
        if (!(std::abs(p[i] - q[i]) <= tolerance_)) return false;
      }
      return true;
    };
    return close(a.position, b.position) && close(a.texture, b.texture) &&
           (!a.normal || close(*a.normal, *b.normal));
  }

  std::vector<Vertex> stored_;
  double tolerance_ = 0;
  bool frozen_ = false;
};

TEST(SippSurfaceBuilder, MergesWhatALinearSearchMerges) {
  // Coordinates near multiples of the tolerance and of the grid, on both sides of zero, at several scales.
  std::mt19937 random(1);
  int merged = 0, kept = 0;
  for (int round = 0; round < 300; ++round) {
    const double size = std::ldexp(1, static_cast<int>(random() % 60) - 30);
    const double far = random() % 3 == 0 ? size * std::ldexp(1, static_cast<int>(random() % 24)) : 0;
    const double d = 1e-10 * size;  // as the second vertex makes it
    const auto jitter = [&] {
      switch (random() % 6) {
        case 0:
          return d * (static_cast<int>(random() % 5) - 2);
        case 1:
          return 0.5 * d * (static_cast<int>(random() % 9) - 4);
        case 2:
          return d * std::uniform_real_distribution(-3.0, 3.0)(random);
        default:
          return 0.0;
      }
    };
    const auto coordinate = [&] {
      const double cell = 64 * d;
      switch (random() % 4) {
        case 0:
          return far + jitter();
        case 1:
          return far + size * (static_cast<int>(random() % 3) - 1) + jitter();
        case 2:
          return cell * (static_cast<int>(random() % 5) - 2 - 0.37) + jitter();
        default:
          return cell * static_cast<int>(random() % 4) + jitter();
      }
    };
    const auto vector = [&] { return V3d(coordinate(), coordinate(), coordinate()); };
    SurfaceBuilder builder;
    Reference reference;
    std::vector<std::size_t> expected;
    const bool with_normals = random() % 2 == 0, with_textures = random() % 2 == 0;
    Vertex v{V3d(far, 0, 0), V3d(0, 0, 0), {}};
    for (int i = 0; i < 400; ++i) {
      if (i == 1) v.position.x += size;
      builder.push_vertex(v);
      expected.push_back(reference.push(v));
      v.position = vector();
      v.texture = with_textures && random() % 2 == 0 ? vector() : V3d(0, 0, 0);
      v.normal.reset();
      if (with_normals && random() % 2 == 0) v.normal = vector();
    }
    builder.push_polygon();
    const auto surface = builder.create(nullptr);
    const auto corners = polygons_of(*surface).at(0);
    ASSERT_EQ(corners.size(), expected.size());
    for (std::size_t i = 0; i < corners.size(); ++i) ASSERT_EQ(corners[i], expected[i]) << round << " " << i;
    kept += static_cast<int>(surface->positions.size());
    merged += 400 - static_cast<int>(surface->positions.size());
  }
  EXPECT_GT(merged, 10'000);
  EXPECT_GT(kept, 10'000);
}

}  // namespace
}  // namespace farop::sipp
