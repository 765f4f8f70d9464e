// SPDX-License-Identifier: GPL-3.0-or-later
#include "solids/check_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/word_reader.h"
#include "parse_nff/parse_nff.h"
#include "scene/surface_builder.h"

namespace farop {
namespace {

using Face = std::vector<V3d>;

/// The six squares of a box, each counter-clockwise seen from outside.
std::vector<Face> box(const V3d& low, const V3d& high) {
  const auto p = [&](int x, int y, int z) {
    return V3d(x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z);
  };
  return {{p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0)}, {p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)},
          {p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1)}, {p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1)},
          {p(1, 1, 0), p(0, 1, 0), p(0, 1, 1), p(1, 1, 1)}, {p(0, 1, 0), p(0, 0, 0), p(0, 0, 1), p(0, 1, 1)}};
}
std::vector<Face> cube() {
  return box(V3d(0, 0, 0), V3d(2, 2, 2));
}
std::vector<Face> reversed(std::vector<Face> faces) {
  for (Face& face : faces) std::reverse(face.begin(), face.end());
  return faces;
}
std::vector<Face> operator+(std::vector<Face> a, const std::vector<Face>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::shared_ptr<Surface> surface_of(const std::vector<Face>& faces) {
  SurfaceBuilder builder;
  for (const Face& face : faces) {
    builder.begin_polygon(false);
    for (const V3d& corner : face) builder.add_corner(corner);
    builder.end_polygon();
  }
  return std::make_shared<Surface>(builder.take());
}

SolidReport check(const std::vector<Face>& faces) {
  Object object;
  object.surfaces.push_back(surface_of(faces));
  return check_solid(object);
}

void expect_flaw(const std::vector<Face>& faces, SolidProperty property, const std::string& text) {
  const SolidReport report = check(faces);
  ASSERT_TRUE(report.flaw.has_value());
  EXPECT_FALSE(report.ok());
  EXPECT_EQ(report.flaw->property, property) << describe(*report.flaw);
  EXPECT_EQ(describe(*report.flaw), text);
}

TEST(CheckSolid, PassesTheSolidsThatShip) {
  struct Case {
    const char* name;
    std::uint64_t polygons, edges, vertices;
  };
  // Euler: vertices - edges + polygons is 2 for the cylinder, 0 with one hole through.
  for (const Case& c : {Case{"hollow-cube", 128, 192, 64}, Case{"solid-torus", 624, 1248, 624},
                        Case{"solid-cylinder", 1992, 3901, 1911}}) {
    WordReader reader(std::string(FAROP_SOURCE_DIR) + "/spd_scenes/" + c.name + ".nff");
    DiagnosticList diagnostics;
    const std::optional<Scene> scene = parse_nff(reader, diagnostics);
    ASSERT_TRUE(scene) << c.name;
    const SolidReport report = check_solid(*scene->root.children.at(0));
    EXPECT_TRUE(report.ok()) << c.name << ": " << (report.flaw ? describe(*report.flaw) : "");
    EXPECT_EQ(report.polygons, c.polygons);
    EXPECT_EQ(report.edges, c.edges);
    EXPECT_EQ(report.vertices, c.vertices);
    EXPECT_EQ(report.shells, 1u);
  }
}

TEST(CheckSolid, PassesACubeWhoseFacesAreSpreadOverSurfacesAndSubObjects) {
  const std::vector<Face> faces = cube();
  Object object;
  object.surfaces.push_back(surface_of({faces[0], faces[1]}));
  object.surfaces.push_back(surface_of({faces[2]}));
  auto child = std::make_shared<Object>();
  child->to_parent.setTranslation(V3d(1, 0, 0));
  std::vector<Face> moved = {faces[3], faces[4], faces[5]};
  for (Face& face : moved) {
    for (V3d& p : face) p.x -= 1;
  }
  child->surfaces.push_back(surface_of(moved));
  object.children.push_back(child);
  const SolidReport report = check_solid(object);
  EXPECT_TRUE(report.ok()) << (report.flaw ? describe(*report.flaw) : "");
  EXPECT_EQ(report.edges, 12u);
  EXPECT_EQ(report.vertices, 8u);
}

TEST(CheckSolid, PassesAMirroredCube) {
  Object object;
  object.to_parent.setScale(V3d(-1, 1, 1));
  object.surfaces.push_back(surface_of(cube()));
  EXPECT_TRUE(check_solid(object).ok());
}

TEST(CheckSolid, PassesSolidsBesideEachOtherAndHollowOnes) {
  EXPECT_TRUE(check(cube() + box(V3d(5, 0, 0), V3d(6, 1, 1))).ok());
  const SolidReport hollow = check(cube() + reversed(box(V3d(0.5, 0.5, 0.5), V3d(1.5, 1.5, 1.5))));
  EXPECT_TRUE(hollow.ok()) << (hollow.flaw ? describe(*hollow.flaw) : "");
  EXPECT_EQ(hollow.shells, 2u);
}

TEST(CheckSolid, PassesConcaveFacesAndFacesWithBridgesToAHole) {
  // A square tube: its ends are squares with a square hole, joined by a bridge that the face walks twice.
  const std::vector<Face> outside = box(V3d(0, 0, 0), V3d(3, 3, 3)),
                          inside = reversed(box(V3d(1, 1, 0), V3d(2, 2, 3)));
  std::vector<Face> tube(outside.begin() + 2, outside.end());
  tube = tube + std::vector<Face>(inside.begin() + 2, inside.end());
  for (int end = 0; end < 2; ++end) {
    Face face = outside[static_cast<std::size_t>(end)], hole = inside[static_cast<std::size_t>(end)];
    while (hole[0] != V3d(1, 1, 3 * end)) std::rotate(hole.begin(), hole.begin() + 1, hole.end());
    ASSERT_EQ(face[0], V3d(0, 0, 3 * end));
    face.push_back(face[0]);
    face.insert(face.end(), hole.begin(), hole.end());
    face.push_back(hole[0]);
    tube.push_back(face);
  }
  const SolidReport report = check(tube);
  EXPECT_TRUE(report.ok()) << (report.flaw ? describe(*report.flaw) : "");
  EXPECT_EQ(report.polygons, 10u);
}

TEST(CheckSolid, RefusesACubeWithoutAFace) {
  std::vector<Face> faces = cube();
  faces.erase(faces.begin() + 4);
  expect_flaw(faces, SolidProperty::closed,
              "not closed: polygon 0 has no neighbour over an edge, at (0, 2, 0)");
}

TEST(CheckSolid, RefusesAGapOfOneBit) {
  std::vector<Face> faces = cube();
  for (V3d& p : faces[1]) {
    if (p == V3d(2, 2, 2)) p.x = std::nextafter(2.0, 3.0);
  }
  ASSERT_TRUE(check(faces).flaw);
  EXPECT_EQ(check(faces).flaw->property, SolidProperty::closed);
}

TEST(CheckSolid, RefusesAFaceTheWrongWayRound) {
  std::vector<Face> faces = cube();
  std::reverse(faces[3].begin(), faces[3].end());
  expect_flaw(
      faces, SolidProperty::oriented,
      "not consistently oriented: polygons 1 and 3 run along their edge in the same direction, at (2, 0, 2)");
}

TEST(CheckSolid, RefusesACubeInsideOut) {
  expect_flaw(reversed(cube()), SolidProperty::outward,
              "not oriented outwards: polygon 0 shows its front to the inside, at (2, 0, 0)");
}

TEST(CheckSolid, RefusesOneOfTwoCubesInsideOut) {
  const SolidReport report = check(cube() + reversed(box(V3d(5, 0, 0), V3d(6, 1, 1))));
  ASSERT_TRUE(report.flaw);
  EXPECT_EQ(report.flaw->property, SolidProperty::outward);
  EXPECT_EQ(report.flaw->polygon, 6u);
}

TEST(CheckSolid, RefusesACubeWithinACubeThatIsNoHollow) {
  const SolidReport report = check(cube() + box(V3d(0.5, 0.5, 0.5), V3d(1.5, 1.5, 1.5)));
  ASSERT_TRUE(report.flaw);
  EXPECT_EQ(report.flaw->property, SolidProperty::outward);
  EXPECT_EQ(report.flaw->polygon, 6u);
}

TEST(CheckSolid, RefusesTwoCubesThatCutThroughEachOther) {
  const SolidReport report = check(cube() + box(V3d(1, 1, 1), V3d(3, 3, 3)));
  ASSERT_TRUE(report.flaw);
  EXPECT_EQ(report.flaw->property, SolidProperty::not_intersecting) << describe(*report.flaw);
  EXPECT_NE(describe(*report.flaw).find("not free of self-intersections: polygons 1 and "), std::string::npos)
      << describe(*report.flaw);
  EXPECT_EQ(report.flaw->polygon, 1u);  // the top of the first and a side of the second
  EXPECT_GE(report.flaw->other_polygon.value_or(0), 6u);
}

TEST(CheckSolid, RefusesTwoCubesThatTouchWithTheirFaces) {
  const SolidReport report = check(cube() + box(V3d(2, 0.5, 0.5), V3d(3, 1.5, 1.5)));
  ASSERT_TRUE(report.flaw);
  EXPECT_EQ(report.flaw->property, SolidProperty::not_intersecting) << describe(*report.flaw);
}

TEST(CheckSolid, RefusesASheetWithTwoSides) {
  const Face square = cube()[0], triangle = {V3d(0, 0, 0), V3d(1, 0, 0), V3d(0, 1, 0)};
  for (const Face& face : {square, triangle}) {
    const SolidReport report = check({face, reversed({face})[0]});
    ASSERT_TRUE(report.flaw);
    EXPECT_EQ(report.flaw->property, SolidProperty::not_intersecting) << describe(*report.flaw);
  }
}

TEST(CheckSolid, RefusesAnEdgeOfFourFaces) {
  expect_flaw(
      cube() + box(V3d(2, 2, 0), V3d(4, 4, 2)), SolidProperty::manifold,
      "not manifold: polygon 3 has more than one neighbour over an edge or in a vertex, at (2, 2, 0)");
}

TEST(CheckSolid, RefusesCubesThatHangTogetherByACorner) {
  expect_flaw(
      cube() + box(V3d(2, 2, 2), V3d(4, 4, 4)), SolidProperty::manifold,
      "not manifold: polygon 6 has more than one neighbour over an edge or in a vertex, at (2, 2, 2)");
}

TEST(CheckSolid, RefusesFacesWithoutArea) {
  std::vector<Face> faces = cube();
  faces.push_back({V3d(0, 0, 0), V3d(1, 0, 0), V3d(2, 0, 0)});
  expect_flaw(faces, SolidProperty::proper_polygons,
              "not made of proper polygons: polygon 6 has no area or a repeated corner, at (0, 0, 0)");
  faces.back() = {V3d(0, 0, 0), V3d(0, 0, 0), V3d(1, 0, 0), V3d(0, 1, 0)};
  const SolidReport report = check(faces);
  ASSERT_TRUE(report.flaw);
  EXPECT_EQ(report.flaw->property, SolidProperty::proper_polygons);
}

TEST(CheckSolid, TakesAnEmptyObjectForNoSolid) {
  const SolidReport report = check_solid(Object());
  EXPECT_FALSE(report.ok());
  EXPECT_FALSE(report.flaw);
}

}  // namespace
}  // namespace farop
