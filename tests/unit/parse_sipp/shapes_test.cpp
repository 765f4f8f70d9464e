// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "scene/plane.h"
#include "solids/check_solid.h"
#include "spd/teapot_patches.h"
#include "unit/parse_sipp/shape_cases.h"

namespace farop::sipp {
namespace {

ShapeLook mapped(TextureMapping texture) {
  return {nullptr, texture};
}

TEST(SippShapes, HaveTheCountsOfTheSpecification) {
  for (const ShapeCase& c : shape_cases()) {
    const Shape shape = c.make({});
    ASSERT_TRUE(shape) << c.name;
    EXPECT_EQ(shape->to_parent, M44d()) << c.name;
    EXPECT_EQ(shape->surfaces.size(), c.surfaces) << c.name;
    EXPECT_EQ(totals_of(shape).polygons, c.polygons) << c.name;
    if (c.vertices != 0) {
      EXPECT_EQ(totals_of(shape).vertices, c.vertices) << c.name;
    }
    for (const auto& [texture, vertices] :
         {std::pair{TextureMapping::cylindrical, c.cylindrical},
          std::pair{TextureMapping::spherical, c.spherical}, std::pair{TextureMapping::natural, c.natural}}) {
      const Shape with_seam = c.make(mapped(texture));
      EXPECT_EQ(totals_of(with_seam).polygons, c.polygons) << c.name;
      EXPECT_EQ(totals_of(with_seam).vertices, vertices)
          << c.name << " with texture mapping " << static_cast<int>(texture);
    }
  }
}

TEST(SippShapes, FillTheirBoxes) {
  for (const ShapeCase& c : shape_cases()) {
    const Bounds box = bounds_of(c.make({}));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(box.low[axis], c.low[axis], 1e-9) << c.name;
      EXPECT_NEAR(box.high[axis], c.high[axis], 1e-9) << c.name;
    }
  }
}

TEST(SippShapes, AreClosedAndLookOutwards) {
  int closed = 0;
  for (const TextureMapping mapping : {TextureMapping::world, TextureMapping::cylindrical,
                                       TextureMapping::spherical, TextureMapping::natural}) {
    for (const ShapeCase& c : shape_cases()) {
      const SolidReport report = check_solid(*without_repeated_corners(*c.make(mapped(mapping))));
      EXPECT_EQ(report.ok(), c.closed) << c.name << (report.flaw ? ": " + describe(*report.flaw) : "");
      closed += static_cast<int>(c.closed);
    }
  }
  EXPECT_EQ(closed, 4 * 13);
}

/// Every directed edge once: neighbours agree about the side that is the front.
void expect_oriented(const Surface& surface, const std::string& name) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const PolygonView polygon : surface.polygons) {
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      const std::uint32_t a = polygon.corners[i], b = polygon.corners[(i + 1) % polygon.corners.size()];
      if (a != b) {
        EXPECT_TRUE(edges.insert({a, b}).second) << name << ": an edge is walked twice in one direction";
      }
    }
  }
}

TEST(SippShapes, OpenOnesAreOrientedToo) {
  for (const ShapeCase& c : shape_cases()) {
    if (c.closed || c.name == "superquadric") continue;
    for_each_surface(*c.make({}), M44d(),
                     [&](const SurfacePlacement& placed) { expect_oriented(placed.surface, c.name); });
  }
}

/// Sum over all polygons of area times distance of their planes from `centre`: three times the volume
/// between.
double volume_round(const Surface& surface, const V3d& centre) {
  double sum = 0;
  for (const PolygonView polygon : surface.polygons) {
    const V3d& a = surface.positions[polygon.corners[0]];
    for (std::size_t i = 1; i + 1 < polygon.corners.size(); ++i) {
      const V3d& b = surface.positions[polygon.corners[i]];
      const V3d& d = surface.positions[polygon.corners[i + 1]];
      sum += (a - centre).dot((b - centre).cross(d - centre));
    }
  }
  return sum / 6;
}

TEST(SippShapes, TheTeapotsPartsLookOutwards) {
  EXPECT_GT(volume_round(*teapot_body(6, {})->surfaces[0], V3d(0, 0, 0)), 0.2);
  EXPECT_GT(volume_round(*teapot_lid(6, {})->surfaces[0], V3d(0, 0, 0.5625)), 0.005);
  EXPECT_GT(volume_round(*teapot_spout(6, {})->surfaces[0], V3d(0.6, 0, 0.35)), 0.005);
  EXPECT_GT(volume_round(*teapot_handle(6, {})->surfaces[0], V3d(-0.7, 0, 0.4125)), 0.002);
  EXPECT_GT(volume_round(*bezier_rotcurves(k_barrel, first_indices(4), 5, {})->surfaces[0], V3d(0, 0, 0)), 5);
}

TEST(SippShapes, TheTeapotIsNewells) {
  // Every patch corner of his set lies on ours, which is smaller by 4 and lower by 0.0375.
  for (const int patch : {16, 17, 18, 19, 12, 13, 14, 15}) {
    const bool spout = patch >= 16;
    const Shape part = spout ? teapot_spout(3, {}) : teapot_handle(3, {});
    const std::vector<V3d>& points = part->surfaces[0]->positions;
    for (const std::size_t corner : {0, 3, 12, 15}) {
      const V3d p = k_teapot_points[k_teapot_patches[static_cast<std::size_t>(patch)][corner]] * 0.25 -
                    V3d(0, 0, 0.0375);
      const bool found =
          std::any_of(points.begin(), points.end(), [&](const V3d& q) { return (p - q).length() < 1e-9; });
      EXPECT_TRUE(found) << patch << ": " << p;
    }
  }
  const Bounds body = bounds_of(teapot_body(8, {}));
  EXPECT_NEAR(body.high.x, 0.5, 0.01);
  EXPECT_EQ(body.low.z, 0);
  EXPECT_NEAR(bounds_of(teapot(8, {})).high.z, 0.75, 1e-12);
}

TEST(SippShapes, SmoothOnesHaveTheNormalsOfTheirShape) {
  const Shape ball = ellipsoid(V3d(1, 1, 1), 40, {});
  const Surface& surface = *ball->surfaces[0];
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    EXPECT_GT(surface.averaged_normals[i].dot(surface.positions[i].normalized()), 0.999);
  }
  const Shape ring = torus(1, 0.3, 80, 40, {});
  const Surface& tube = *ring->surfaces[0];
  for (std::size_t i = 0; i < tube.positions.size(); ++i) {
    const V3d& p = tube.positions[i];
    const V3d centre = V3d(p.x, p.y, 0).normalized();
    EXPECT_GT(tube.averaged_normals[i].dot((p - centre).normalized()), 0.999);
  }
  // The rims of a cylinder are hard: side normals are horizontal.
  const Shape pipe = cylinder(1, 2, 30, {});
  for (const V3d& n : pipe->surfaces[2]->averaged_normals) EXPECT_NEAR(n.z, 0, 1e-12);
  for (const V3d& n : pipe->surfaces[0]->averaged_normals) EXPECT_NEAR(n.z, -1, 1e-12);
}

TEST(SippShapes, ComeInSippsOrder) {
  // Lists are in reverse: the polygon made last comes first.
  const Shape shape = torus(1, 0.25, 4, 4, {});
  const Surface& s = *shape->surfaces[0];
  PolygonView last;
  for (const PolygonView p : s.polygons) last = p;
  const double r = 0.25 * std::sqrt(0.5);
  const std::vector<V3d> first_quad = {V3d(1 + r, 0, -r), V3d(0, 1 + r, -r), V3d(0, 1 + r, r),
                                       V3d(1 + r, 0, r)};
  ASSERT_EQ(last.corners.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR((s.positions[last.corners[i]] - first_quad[i]).length(), 0, 1e-12) << i;
  }
  const Shape box = block(V3d(2, 4, 6), {});
  const std::vector<V3d> normals = {V3d(0, 0, 1), V3d(0, 0, -1), V3d(1, 0, 0),
                                    V3d(0, 1, 0), V3d(-1, 0, 0), V3d(0, -1, 0)};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(*plane_normal(box->surfaces[i]->positions, (*box->surfaces[i]->polygons.begin()).corners),
              normals[i]);
  }
}

/// Texture coordinates by position, rounded; positions must not repeat.
V3d texture_at(const Surface& surface, const V3d& position) {
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    if ((surface.positions[i] - position).length() < 1e-6) return V3d(surface.textures[i]);
  }
  ADD_FAILURE() << "no vertex at " << position;
  return V3d(0, 0, 0);
}

void expect_near(const V3d& a, const V3d& b) {
  EXPECT_NEAR((a - b).length(), 0, 1e-6) << a << " instead of " << b;
}

TEST(SippShapes, AreTextured) {
  const V3d on_box(1, 2, 3);
  expect_near(texture_at(*block(V3d(2, 4, 6), {})->surfaces[0], on_box), on_box);
  // Sides of a prism: u along the perimeter from point 0 = (1, -2).
  const Shape natural = block(V3d(2, 4, 6), mapped(TextureMapping::natural));
  expect_near(texture_at(*natural->surfaces[2], on_box), V3d(4.0 / 12, 1, 0));
  expect_near(texture_at(*natural->surfaces[2], V3d(1, -2, -3)), V3d(0, 0, 0));
  expect_near(texture_at(*natural->surfaces[5], V3d(1, -2, 3)), V3d(1, 1, 0));
  expect_near(texture_at(*natural->surfaces[0], on_box), V3d(0, 1, 0));
  expect_near(texture_at(*natural->surfaces[1], V3d(1, 2, -3)), V3d(0, 0, 0));
  const Shape cylindrical = block(V3d(2, 4, 6), mapped(TextureMapping::cylindrical));
  expect_near(texture_at(*cylindrical->surfaces[2], on_box), V3d(2 * std::atan2(2, 1) / (2 * k_pi), 1, 0));
  const Shape spherical = block(V3d(2, 4, 6), mapped(TextureMapping::spherical));
  const double v = std::atan(3 / std::sqrt(5.0)) / k_pi + 0.5;
  expect_near(texture_at(*spherical->surfaces[2], V3d(1, -2, 3)), V3d(0, v, 0));
  expect_near(texture_at(*spherical->surfaces[2], V3d(1, -2, -3)), V3d(0, 1 - v, 0));

  const Shape pipe = cylinder(1, 2, 4, mapped(TextureMapping::natural));
  expect_near(texture_at(*pipe->surfaces[2], V3d(0, 1, 1)), V3d(0.25, 1, 1));
  expect_near(texture_at(*pipe->surfaces[0], V3d(0, 1, -1)), V3d(0.25, 0, -1));
  const Shape round = cylinder(1, 2, 4, mapped(TextureMapping::spherical));
  expect_near(texture_at(*round->surfaces[2], V3d(0, 1, 1)), V3d(0.25, 0.75, 1));

  const Shape ball = sphere(1, 8, mapped(TextureMapping::cylindrical));
  expect_near(texture_at(*ball->surfaces[0], V3d(0, 1, 0)), V3d(0.25, 0.5, 0));
  const Shape globe = sphere(1, 8, mapped(TextureMapping::natural));
  const double s = std::sqrt(0.5);
  // Upper edge of the upper band: v of the lower one; and the cap's own.
  std::set<double> vs;
  for (std::size_t i = 0; i < globe->surfaces[0]->positions.size(); ++i) {
    if ((globe->surfaces[0]->positions[i] - V3d(0, s, s)).length() < 1e-9) {
      vs.insert(globe->surfaces[0]->textures[i].y);
    }
  }
  EXPECT_EQ(vs, (std::set<double>{0.5, 0.75}));

  const Shape ring = torus(2, 1, 8, 4, mapped(TextureMapping::natural));
  expect_near(texture_at(*ring->surfaces[0], V3d(0, 2 + s, -s)), V3d(0.25, 0, 0));
}

TEST(SippShapes, AnswerBadArgumentsWithNothing) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  const std::vector<V2d> two = {{0, 0}, {1, 1}};
  const std::vector<V2d> bad = {{0, 0}, {1, 1}, {nan, 2}};
  const std::vector<V3d> nowhere = {V3d(inf, 0, 0), V3d(0, 0, 0), V3d(0, 0, 0), V3d(0, 0, 0)};
  const std::vector<int> outside = {0, 1, 2, 4}, negative = {0, 1, 2, -1};
  for (const Shape& shape : {cone(-1, 1, 1, 8, {}),
                             cone(1, -1, 1, 8, {}),
                             cone(0, 0, 1, 8, {}),
                             cone(1, 1, nan, 8, {}),
                             cylinder(1, 1, 0, {}),
                             torus(1, 1, 0, 3, {}),
                             torus(1, inf, 3, 3, {}),
                             sphere(1, 0, {}),
                             sphere(nan, 8, {}),
                             prism(two, 1, {}),
                             prism(bad, 1, {}),
                             block(V3d(1, nan, 1), {}),
                             bezier_patches({}, {}, 3, {}),
                             bezier_patches(flat_net(), first_indices(15), 3, {}),
                             bezier_rotcurves(nowhere, first_indices(4), 3, {}),
                             bezier_rotcurves(k_barrel, outside, 3, {}),
                             bezier_rotcurves(k_barrel, negative, 3, {}),
                             bezier_rotcurves(k_barrel, first_indices(4), 0, {}),
                             teapot(0, {}),
                             superquadric(V3d(1, 1, 1), nan, 1, 0, {})}) {
    EXPECT_EQ(shape, nullptr);
  }
}

TEST(SippShapes, RefuseMorePolygonsThanAllowed) {
  constexpr int most = std::numeric_limits<int>::max();
  const ShapeLook few{nullptr, TextureMapping::world, 100};
  EXPECT_NO_THROW(torus(1, 1, 10, 10, few));
  EXPECT_THROW(torus(1, 1, 10, 11, few), Error);
  EXPECT_THROW(torus(1, 1, most, most, {}), Error);
  EXPECT_THROW(sphere(1, most, {}), Error);
  EXPECT_THROW(cylinder(1, 1, most, {}), Error);
  EXPECT_THROW(teapot(most, {}), Error);
  EXPECT_THROW(teapot_handle(most, {}), Error);
  EXPECT_THROW(bezier_rotcurves(k_barrel, first_indices(4), most, {}), Error);
  EXPECT_THROW(bezier_patches(flat_net(), first_indices(16), most, {}), Error);
}

TEST(SippShapes, AWindingTheWrongWayRoundGivesAPrismInsideOut) {
  const SolidReport report =
      check_solid(*prism(std::vector<V2d>(k_pentagon.rbegin(), k_pentagon.rend()), 5, {}));
  ASSERT_TRUE(report.flaw);
  EXPECT_EQ(report.flaw->property, SolidProperty::outward);
}

}  // namespace
}  // namespace farop::sipp
