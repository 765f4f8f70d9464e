// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/tessellate.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.h"
#include "scene/surface_builder.h"

namespace farop {
namespace {

using Triangle = std::array<TessellationCorner, 3>;

template <class Primitive>
std::vector<Triangle> triangles_of(const Primitive& primitive, int resolution) {
  std::vector<Triangle> triangles;
  tessellate(primitive, resolution, [&](const TessellationCorner(&t)[3]) {
    triangles.push_back({t[0], t[1], t[2]});
  });
  return triangles;
}

V3d plane_normal(const Triangle& t) {
  return (t[1].position - t[0].position).cross(t[2].position - t[1].position);
}

bool same_bits(const Triangle& a, const Triangle& b) {
  const auto bits = [](const Triangle& triangle) {
    std::vector<std::uint64_t> all;
    for (const auto& [position, normal] : triangle)
      for (int i = 0; i < 3; ++i)
        all.insert(all.end(),
                   {std::bit_cast<std::uint64_t>(position[i]), std::bit_cast<std::uint64_t>(normal[i])});
    return all;
  };
  return bits(a) == bits(b);
}

std::shared_ptr<Surface> shared_surface(SurfaceBuilder& builder) {
  return std::make_shared<Surface>(builder.take());
}

/// A scene of one object with one surface.
Scene scene_of(std::shared_ptr<Surface> surface) {
  auto object = std::make_shared<Object>();
  object->surfaces.push_back(std::move(surface));
  Scene scene;
  scene.root.children.push_back(object);
  return scene;
}

/// Directed edges of a surface by vertex indices, with the number of uses.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed_edges(const Surface& surface) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const PolygonView polygon : surface.polygons)
    for (std::size_t i = 0; i < polygon.corners.size(); ++i)
      ++edges[{polygon.corners[i], polygon.corners[(i + 1) % polygon.corners.size()]}];
  return edges;
}

int unmatched_edges(const Surface& surface) {
  const auto edges = directed_edges(surface);
  int unmatched = 0;
  for (const auto& [edge, uses] : edges) {
    EXPECT_EQ(uses, 1);
    if (!edges.contains({edge.second, edge.first})) ++unmatched;
  }
  return unmatched;
}

const Sphere k_sphere{{1.25, -2.5, 0.75}, 1.5};
const Cone k_cone{{1, 2, 3}, 0.75, {-1, 3, 5}, 0.25};
const Cone k_cylinder{{0, 0, 1}, 0.5, {0, 0, 4}, 0.5};

// 1. Construction

TEST(TessellatedSphere, HasTwelveTrianglesTimesTheSquareOfTheResolution) {
  for (const int r : {1, 2, 3, 4, 7, 16}) EXPECT_EQ(triangles_of(k_sphere, r).size(), 12u * r * r);
}

TEST(TessellatedSphere, HasCornersOnTheSphereAndUnitNormalsAlongTheRadius) {
  for (const Triangle& t : triangles_of(k_sphere, 5)) {
    for (const auto& [position, normal] : t) {
      EXPECT_NEAR((position - k_sphere.center).length(), k_sphere.radius, 1e-14);
      EXPECT_NEAR(normal.length(), 1, 1e-15);
      EXPECT_NEAR((position - k_sphere.center - normal * k_sphere.radius).length(), 0, 1e-15);
    }
  }
}

TEST(TessellatedSphere, TurnsItsTrianglesOutwards) {
  for (const Triangle& t : triangles_of(k_sphere, 4)) EXPECT_GT(plane_normal(t).dot(t[0].normal), 0);
}

TEST(TessellatedSphere, BeginsWithTheFaceTowardsMinusX) {
  // R = 1: the grid is (u, -v, 1) / sqrt 3 for u, v = -1, 1, turned by (x, y, z) -> (-z, y, x).
  const auto triangles = triangles_of(Sphere{{0, 0, 0}, std::sqrt(3.0)}, 1);
  const V3d expected[6] = {{-1, 1, -1}, {-1, -1, -1}, {-1, -1, 1}, {-1, -1, 1}, {-1, 1, 1}, {-1, 1, -1}};
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR((triangles[i / 3][i % 3].position - expected[i]).length(), 0, 1e-15) << i;
}

TEST(TessellatedSphere, StepsByEqualAngles) {
  // Along the middle of a face of R = 4 the directions are 22.5 degrees apart.
  const auto triangles = triangles_of(Sphere{{0, 0, 0}, 1}, 4);
  const V3d a = triangles[2 * 2][0].normal, b = triangles[2 * 2][2].normal;  // (u, v) = (0, 2) and (1, 3)
  const V3d along_middle = triangles[2 * 2 + 1][1].normal;                   // (u, v) = (1, 2)
  EXPECT_NEAR(std::acos(a.dot(along_middle)), std::numbers::pi / 8, 1e-12);
  EXPECT_LT(b.dot(a), along_middle.dot(a));
}

TEST(TessellatedSphere, IsClosedOnceEqualVerticesAreOne) {
  for (const V3d& center : {V3d(0, 0, 0), V3d(-0.0, -0.0, -0.0), V3d(1e5, -3, 0.1), V3d(1, 1, 1)}) {
    for (const int r : {1, 2, 3, 6, 11, 32}) {
      for (const bool inside : {false, true}) {
        SurfaceBuilder builder;
        builder.add(Sphere{center, 1, inside});
        Scene scene = scene_of(shared_surface(builder));
        tessellate_scene(scene, {.fixed = r, .view = {}});
        const Surface& surface = *scene.root.children[0]->surfaces[0];
        EXPECT_EQ(unmatched_edges(surface), 0) << "resolution " << r;
        EXPECT_EQ(surface.positions.size(), 6u * r * r + 2) << "resolution " << r;
      }
    }
  }
}

TEST(TessellatedCone, HasEightTrianglesTimesTheResolution) {
  for (const int r : {1, 2, 3, 4, 9, 64}) {
    EXPECT_EQ(triangles_of(k_cone, r).size(), 8u * r);
    EXPECT_EQ(triangles_of(k_cylinder, r).size(), 8u * r);
  }
}

TEST(TessellatedCone, HasCornersOnItsTwoRims) {
  const V3d axis = (k_cone.apex - k_cone.base).normalized();
  for (const Triangle& t : triangles_of(k_cone, 3)) {
    for (const auto& [position, normal] : t) {
      const double along = (position - k_cone.base).dot(axis);
      const bool at_base = std::abs(along) < 1e-14;
      EXPECT_NEAR(along, at_base ? 0 : 3, 1e-14);
      const double radius = at_base ? k_cone.base_radius : k_cone.apex_radius;
      EXPECT_NEAR((position - (at_base ? k_cone.base : k_cone.apex)).length(), radius, 1e-14);
    }
  }
}

TEST(TessellatedCone, HasUnitNormalsAcrossItsSideLines) {
  const auto triangles = triangles_of(k_cone, 3);
  for (std::size_t i = 0; i < triangles.size(); i += 2) {
    // Second and third corner: one side line, from the apex rim to the base rim; both have its normal.
    const auto& [current, apex, base] = triangles[i];
    EXPECT_NEAR(apex.normal.length(), 1, 1e-15);
    EXPECT_EQ(apex.normal, base.normal);
    EXPECT_NEAR(apex.normal.dot(base.position - apex.position), 0, 1e-14);
    // Outwards, and towards the apex, where the cone is narrower.
    EXPECT_GT(apex.normal.dot(apex.position - k_cone.apex), 0);
    EXPECT_GT(apex.normal.dot(k_cone.apex - k_cone.base), 0);
  }
}

TEST(TessellatedCone, TurnsItsTrianglesOutwards) {
  for (const Cone& cone : {k_cone, k_cylinder, Cone{{0, 0, 0}, 0.2, {1, 0, 0}, 0.7}})
    for (const Triangle& t : triangles_of(cone, 3)) EXPECT_GT(plane_normal(t).dot(t[0].normal), 0);
}

TEST(TessellatedCone, BeginsAcrossTheAxisAndZ) {
  // Along x: x cross z = -y. Along z: z cross x = y.
  const auto along_x = triangles_of(Cone{{0, 0, 0}, 1, {2, 0, 0}, 1}, 1);
  EXPECT_NEAR((along_x[0][1].position - V3d(2, -1, 0)).length(), 0, 1e-15);
  EXPECT_NEAR((along_x[0][0].position - V3d(2, 0, -1)).length(), 0, 1e-15);
  const auto along_z = triangles_of(Cone{{0, 0, 0}, 1, {0, 0, 2}, 1}, 1);
  EXPECT_NEAR((along_z[0][1].position - V3d(0, 1, 2)).length(), 0, 1e-15);
}

TEST(TessellatedCone, IsOpenAtItsTwoRimsOnlyOnceEqualVerticesAreOne) {
  for (const Cone& cone : {k_cone, k_cylinder}) {
    SurfaceBuilder builder;
    builder.add(cone);
    Scene scene = scene_of(shared_surface(builder));
    tessellate_scene(scene, {.fixed = 3, .view = {}});
    const Surface& surface = *scene.root.children[0]->surfaces[0];
    EXPECT_EQ(surface.positions.size(), 24u);
    EXPECT_EQ(unmatched_edges(surface), 24);
  }
}

TEST(TessellatedCone, WithAPointHasItsFlatTrianglesToo) {
  const auto triangles = triangles_of(Cone{{0, 0, 0}, 1, {0, 0, 1}, 0}, 3);
  ASSERT_EQ(triangles.size(), 24u);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    EXPECT_EQ(plane_normal(triangles[i]).length() == 0, i % 2 == 0) << i;
}

TEST(TessellatedCone, OfAnySizeHasFiniteUnitNormals) {
  for (const double s : {1e-300, 1e-100, 1e-9, 1e-7, 1.0, 1e9, 1e100, 1e300}) {
    for (const V3d& direction : {V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1), V3d(1, 1, 1), V3d(1e-8, 0, 1)}) {
      for (const Triangle& t : triangles_of(Cone{{0, 0, 0}, s, direction * s, 0.5 * s}, 2))
        for (const auto& [position, normal] : t) ASSERT_NEAR(normal.length(), 1, 1e-12) << s;
    }
  }
}

TEST(InsideVisiblePrimitives, AreTheSameTrianglesReversedWithNegatedNormals) {
  const auto check = [](auto primitive) {
    const auto outside = triangles_of(primitive, 3);
    primitive.inside_visible = true;
    const auto inside = triangles_of(primitive, 3);
    ASSERT_EQ(inside.size(), outside.size());
    for (std::size_t i = 0; i < inside.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(inside[i][k].position, outside[i][2 - k].position);
        EXPECT_EQ(inside[i][k].normal, -outside[i][2 - k].normal);
      }
      EXPECT_GT(plane_normal(inside[i]).dot(inside[i][0].normal), 0);
    }
  };
  check(k_sphere);
  check(k_cone);
}

TEST(EqualPrimitives, GiveTheSameTrianglesBitForBit) {
  const auto check = [](const auto& primitive) {
    const auto first = triangles_of(primitive, 5), second = triangles_of(primitive, 5);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) ASSERT_TRUE(same_bits(first[i], second[i]));
  };
  check(k_sphere);
  check(k_cone);
  check(k_cylinder);
}

// 2. Automatic resolution

TEST(AutoResolution, OfASphereFollowsItsRadiusInPixels) {
  // t = 0.5, H = 101: p = r 100 / max(D - r, r/16).
  const DetailView view{{0, 0, 0}, 0.5, 101};
  EXPECT_EQ(auto_resolution(Sphere{{0, 0, 11}, 1}, view), 3);     // p = 10: 2.48
  EXPECT_EQ(auto_resolution(Sphere{{0, 101, 0}, 1}, view), 1);    // p = 1: 0.785
  EXPECT_EQ(auto_resolution(Sphere{{-2, 0, 0}, 1}, view), 8);     // p = 100: 7.85
  EXPECT_EQ(auto_resolution(Sphere{{0, 0, 1e9}, 1}, view), 1);    // far away
  EXPECT_EQ(auto_resolution(Sphere{{0, 0, 0.5}, 1}, view), 32);   // around the eye: p = 1600: 31.4
  EXPECT_EQ(auto_resolution(Sphere{{0, 0, 1.05}, 1}, view), 32);  // D - r = 0.05 < 1/16
}

TEST(AutoResolution, IsNeverAboveSixtyFour) {
  EXPECT_EQ(auto_resolution(Sphere{{0, 0, 0}, 1}, {{0, 0, 0}, 1e-6, 32767}), 64);
  // p = 16 (H-1) / 2t = 8 (H-1) at t = 1: 0.785 sqrt(6640) = 63.97, 0.785 sqrt(6648) = 64.005.
  EXPECT_EQ(auto_resolution(Sphere{{0, 0, 0}, 1}, {{0, 0, 0}, 1, 831}), 64);
  EXPECT_EQ(auto_resolution(Sphere{{0, 0, 0}, 1}, {{0, 0, 0}, 1, 832}), 64);
  EXPECT_EQ(auto_resolution(Sphere{{0, 0, 0}, 1}, {{0, 0, 0}, 1, 807}), 64);  // 0.785 sqrt(6448) = 63.03
  EXPECT_EQ(auto_resolution(Sphere{{0, 0, 0}, 1}, {{0, 0, 0}, 1, 806}), 63);  // 0.785 sqrt(6440) = 62.996
  EXPECT_EQ(auto_resolution(Sphere{{0, 0, 0}, 1}, {{0, 0, 0}, 1, 801}), 63);  // 0.785 * 80 = 62.8
}

TEST(AutoResolution, OfOneRowIsOne) {
  EXPECT_EQ(auto_resolution(Sphere{{0, 0, 2}, 1}, {{0, 0, 0}, 0.5, 1}), 1);
}

TEST(AutoResolution, OfAConeTakesTheLargerRadiusAndTheDistanceFromTheAxisSegment) {
  const DetailView view{{0, 0, 0}, 0.5, 101};
  // Beside the segment: distance 11 from the line x = 11.
  EXPECT_EQ(auto_resolution(Cone{{11, 0, -5}, 0.5, {11, 0, 5}, 1}, view), 3);
  EXPECT_EQ(auto_resolution(Cone{{11, 0, -5}, 1, {11, 0, 5}, 0.25}, view), 3);
  // The line passes 2 from the eye, yet the segment begins 101 away: p = 1.
  EXPECT_EQ(auto_resolution(Cone{{2, 0, 100.98}, 1, {2, 0, 200}, 1}, view), 1);
  EXPECT_EQ(auto_resolution(Cone{{2, 0, -200}, 1, {2, 0, -100.98}, 1}, view), 1);
  EXPECT_EQ(auto_resolution(Cone{{2, 0, -200}, 1, {2, 0, 200}, 1}, view), 8);
}

TEST(AutoResolution, OfAbsurdNumbersIsStillInRange) {
  const double huge = 1e308;
  for (const double r : {1e-308, 1.0, huge}) {
    for (const double x : {0.0, 1.0, huge}) {
      const DetailView view{{-x, 0, 0}, 0.5, 512};
      for (const int resolution : {auto_resolution(Sphere{{x, x, x}, r}, view),
                                   auto_resolution(Cone{{x, 0, 0}, r, {-huge, 1, 1}, r}, view)}) {
        EXPECT_GE(resolution, 1);
        EXPECT_LE(resolution, 64);
      }
    }
  }
}

// 3. Scenes

void add_triangle(SurfaceBuilder& builder, double x) {
  builder.begin_polygon(false);
  for (const V3d& p : {V3d(x, 0, 0), V3d(x + 1, 0, 0), V3d(x, 1, 0)}) builder.add_corner(p);
  builder.end_polygon();
}

TEST(TessellatedScene, KeepsTheOrderOfPolygonsSpheresAndCones) {
  SurfaceBuilder builder;
  builder.add(k_sphere);
  add_triangle(builder, 100);
  add_triangle(builder, 200);
  builder.add(k_cone);
  builder.add(k_sphere);
  add_triangle(builder, 300);
  builder.add(k_cylinder);
  Scene scene = scene_of(shared_surface(builder));
  tessellate_scene(scene, {.fixed = 1, .view = {}});

  const Surface& surface = *scene.root.children[0]->surfaces[0];
  EXPECT_TRUE(surface.curved.empty());
  std::vector<V3d> first_corners;
  std::vector<bool> given;
  for (const PolygonView polygon : surface.polygons) {
    first_corners.push_back(surface.positions[polygon.corners[0]]);
    given.push_back(polygon.has_given_normals);
  }
  ASSERT_EQ(first_corners.size(), 12u + 2 + 8 + 12 + 1 + 8);
  EXPECT_EQ(first_corners[0], triangles_of(k_sphere, 1)[0][0].position);
  EXPECT_EQ(first_corners[12], V3d(100, 0, 0));
  EXPECT_EQ(first_corners[13], V3d(200, 0, 0));
  EXPECT_EQ(first_corners[14], triangles_of(k_cone, 1)[0][0].position);
  EXPECT_EQ(first_corners[22], triangles_of(k_sphere, 1)[0][0].position);
  EXPECT_EQ(first_corners[34], V3d(300, 0, 0));
  EXPECT_EQ(first_corners[35], triangles_of(k_cylinder, 1)[0][0].position);
  for (std::size_t i = 0; i < given.size(); ++i) EXPECT_EQ(given[i], i != 12 && i != 13 && i != 34) << i;
}

TEST(TessellatedScene, KeepsMaterialsPolygonsNormalsAndSurfacesWithoutCurves) {
  Material red;
  red.color = {1, 0, 0};
  SurfaceBuilder builder(red);
  builder.begin_polygon(true);
  for (const V3d& p : {V3d(0, 0, 0), V3d(1, 0, 0), V3d(0, 1, 0), V3d(-1, -1, 0)})
    builder.add_corner(p, V3d(0, 0, 7));
  builder.end_polygon();
  const Surface plain = builder.take(red);
  auto untouched = std::make_shared<Surface>(plain);
  auto with_sphere = std::make_shared<Surface>(plain);
  with_sphere->curved.push_back({CurvedPrimitive::Kind::sphere, k_sphere, {}, 1});
  Scene scene = scene_of(with_sphere);
  scene.root.surfaces.push_back(untouched);
  tessellate_scene(scene, {.fixed = 1, .view = {}});

  EXPECT_EQ(*untouched, plain);
  EXPECT_EQ(with_sphere->material, red);
  ASSERT_EQ(with_sphere->polygons.size(), 13u);
  const PolygonView first = *with_sphere->polygons.begin();
  ASSERT_EQ(first.corners.size(), 4u);
  EXPECT_TRUE(first.has_given_normals);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(with_sphere->positions[first.corners[i]], plain.positions[i]);
    EXPECT_EQ(with_sphere->normals[first.corners[i]], V3d(0, 0, 7));
  }
}

TEST(TessellatedScene, WithDetailZeroLeavesCurvesOutAndCountsThem) {
  SurfaceBuilder builder;
  builder.add(k_sphere);
  add_triangle(builder, 0);
  builder.add(k_sphere);
  builder.add(k_cone);
  Scene scene = scene_of(shared_surface(builder));
  tessellate_scene(scene, {.fixed = 0, .view = {}});
  const Surface& surface = *scene.root.children[0]->surfaces[0];
  EXPECT_TRUE(surface.curved.empty());
  EXPECT_EQ(surface.polygons.size(), 1u);
  EXPECT_EQ(scene.spheres_skipped, 2u);
  EXPECT_EQ(scene.cones_skipped, 1u);
}

TEST(TessellatedScene, WithoutACameraTakesResolutionThree) {
  SurfaceBuilder builder;
  builder.add(k_sphere);
  builder.add(k_cone);
  Scene scene = scene_of(shared_surface(builder));
  tessellate_scene(scene, {});
  EXPECT_EQ(scene.root.children[0]->surfaces[0]->polygons.size(), 108u + 24u);
  EXPECT_EQ(scene.spheres_skipped + scene.cones_skipped, 0u);
}

TEST(TessellatedScene, ChoosesAnAutomaticResolutionForEveryPrimitive) {
  SurfaceBuilder builder;
  builder.add(Sphere{{0, 0, 11}, 1});                // 3
  builder.add(Sphere{{0, 101, 0}, 1});               // 1
  builder.add(Cone{{11, 0, -5}, 1, {11, 0, 5}, 1});  // 3
  Scene scene = scene_of(shared_surface(builder));
  tessellate_scene(scene, {.fixed = {}, .view = DetailView{{0, 0, 0}, 0.5, 101}});
  EXPECT_EQ(scene.root.children[0]->surfaces[0]->polygons.size(), 108u + 12u + 24u);
}

TEST(TessellatedScene, MeasuresPrimitivesInWorldSpace) {
  // 0.1 in radius at 1.1, under a child scaled by 2 within a parent scaled by 5: radius 1 at distance 11.
  SurfaceBuilder builder;
  builder.add(Sphere{{0, 0, 0.1}, 0.1});
  auto child = std::make_shared<Object>();
  child->to_parent = M44d().setScale(2.0) * M44d().setTranslation(V3d(0, 0, 2));
  child->surfaces.push_back(shared_surface(builder));
  auto parent = std::make_shared<Object>();
  parent->to_parent = M44d().setScale(5.0);
  parent->children.push_back(child);
  Scene scene;
  scene.root.children.push_back(parent);
  tessellate_scene(scene, {.fixed = {}, .view = DetailView{{0, 0, 0}, 0.5, 101}});
  EXPECT_EQ(child->surfaces[0]->polygons.size(), 108u);
}

/// Two objects that share a surface; the second stands at `second`.
Scene instanced_scene(const std::shared_ptr<Surface>& surface, const V3d& second) {
  Scene scene = scene_of(surface);
  auto object = std::make_shared<Object>(*scene.root.children[0]);
  object->to_parent = M44d().setTranslation(second);
  scene.root.children.push_back(object);
  return scene;
}

TEST(TessellatedScene, TessellatesAnInstancedSurfaceOnce) {
  SurfaceBuilder builder;
  builder.add(k_sphere);
  Scene scene = instanced_scene(shared_surface(builder), {5, 0, 0});
  tessellate_scene(scene, {.fixed = 2, .view = {}});
  EXPECT_EQ(scene.root.children[0]->surfaces[0], scene.root.children[1]->surfaces[0]);
  EXPECT_EQ(scene.root.children[0]->surfaces[0]->polygons.size(), 48u);
}

TEST(TessellatedScene, GivesAnInstancedSurfaceTheResolutionOfItsNearestPlacement) {
  for (const double sign : {1.0, -1.0}) {
    SurfaceBuilder builder;
    builder.add(Sphere{{0, 0, sign > 0 ? 101.0 : 11.0}, 1});
    Scene scene =
        instanced_scene(shared_surface(builder), {0, 0, -90 * sign});  // to 11, or to 101 from the eye
    tessellate_scene(scene, {.fixed = {}, .view = DetailView{{0, 0, 0}, 0.5, 101}});
    EXPECT_EQ(scene.root.children[0]->surfaces[0]->polygons.size(), 108u);
  }
}

TEST(TessellatedScene, CountsSkippedPrimitivesOncePerPlacement) {
  SurfaceBuilder builder;
  builder.add(k_sphere);
  Scene scene = instanced_scene(shared_surface(builder), {5, 0, 0});
  tessellate_scene(scene, {.fixed = 0, .view = {}});
  EXPECT_EQ(scene.spheres_skipped, 2u);
}

TEST(TessellatedScene, RefusesMoreTrianglesThanMemoryHoldsBeforeMakingAny) {
  SurfaceBuilder builder;
  for (int i = 0; i < 30; ++i) builder.add(Sphere{V3d(i, 0, 0), 1, false});
  Scene scene;
  scene.root.children.push_back(std::make_shared<Object>());
  scene.root.children[0]->surfaces.push_back(std::make_shared<Surface>(builder.take()));
  try {
    tessellate_scene(scene, {k_max_detail, std::nullopt});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::surroundings);
    EXPECT_NE(error.hint().find("--detail"), std::string::npos);
  }
}

}  // namespace
}  // namespace farop
