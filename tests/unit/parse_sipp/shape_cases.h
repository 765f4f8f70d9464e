// SPDX-License-Identifier: GPL-3.0-or-later
// What the specification says of every primitive: counts, boxes, closedness. For the model and for scripts.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "parse_sipp/sipp_shapes.h"
#include "scene/bounds.h"
#include "scene/traverse.h"

namespace farop::sipp {

constexpr double k_pi = std::numbers::pi;
using Shape = std::shared_ptr<Object>;
using Make = std::function<Shape(const ShapeLook&)>;

inline SceneTotals totals_of(const Shape& shape) {
  Scene scene;
  scene.root.children.push_back(shape);
  return totals(scene);
}

inline Bounds bounds_of(const Shape& shape) {
  Scene scene;
  scene.root.children.push_back(shape);
  return world_bounds(scene).value();
}

/// Polygons without corners in the place of the one before: two-dimensional textures give poles and centres
/// of caps two vertices in every polygon (that is how SIPP makes them).
inline Shape without_repeated_corners(const Object& object) {
  auto out = std::make_shared<Object>();
  out->to_parent = object.to_parent;
  for (const auto& surface : object.surfaces) {
    auto copy = std::make_shared<Surface>(*surface);
    PolygonRecorder polygons;
    for (const PolygonView polygon : surface->polygons) {
      polygons.begin_polygon(false);
      for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
        const std::uint32_t corner = polygon.corners[i];
        const std::uint32_t before = polygon.corners[i > 0 ? i - 1 : polygon.corners.size() - 1];
        if (surface->positions[corner] != surface->positions[before]) polygons.add_corner(corner);
      }
      polygons.end_polygon();
    }
    copy->polygons = polygons.take();
    out->surfaces.push_back(copy);
  }
  for (const auto& child : object.children) out->children.push_back(without_repeated_corners(*child));
  return out;
}

inline const std::vector<V2d> k_pentagon = {{0.5, -1}, {-1, 0.5}, {1, 1}, {-1, 2}, {-2, 0.5}};
inline const std::vector<V2d> k_arrow = {{0, -1}, {2, -1}, {1, 0}, {2, 1}, {0, 1}};  // concave

inline std::vector<V3d> flat_net() {
  std::vector<V3d> points;
  for (int i = 0; i < 16; ++i) points.emplace_back(i % 4, i / 4, (i % 4) * 0.5);
  return points;
}
inline std::vector<int> first_indices(int count) {
  std::vector<int> out;
  for (int i = 0; i < count; ++i) out.push_back(i);
  return out;
}
inline const std::vector<V3d> k_barrel = {V3d(1, 0, -1), V3d(1.5, 0, -0.3), V3d(1.5, 0, 0.3), V3d(1, 0, 1)};

/// What the specification says of one call. Vertices are counted for the mappings in their order.
struct ShapeCase {
  std::string name;
  Make make;
  std::string command;  ///< of a script, without the texture mapping; $s is a shader
  std::size_t surfaces;
  std::uint64_t polygons;
  std::uint64_t vertices;  ///< world; 0: not said
  std::uint64_t cylindrical, spherical, natural;
  V3d low, high;  ///< exactly: sharp corners, and the steps that hit the axes
  bool closed;
};

inline std::vector<ShapeCase> shape_cases() {
  const double rim = std::sqrt(0.5);
  // A tube of 15 steps begins at -45 degrees: its highest step lies at 75 + ... degrees.
  double tube_out = -1, tube_up = -1, tube_down = 1;
  for (int i = 0; i < 15; ++i) {
    const double a = i * 2 * k_pi / 15 - k_pi / 4;
    tube_out = std::max(tube_out, std::cos(a));
    tube_up = std::max(tube_up, std::sin(a)), tube_down = std::min(tube_down, std::sin(a));
  }
  const double ring = 1 + 0.4 * tube_out;
  const std::string net =
      "{{0 0 0} {1 0 .5} {2 0 1} {3 0 1.5}  {0 1 0} {1 1 .5} {2 1 1} {3 1 1.5}\n"
      " {0 2 0} {1 2 .5} {2 2 1} {3 2 1.5}  {0 3 0} {1 3 .5} {2 3 1} {3 3 1.5}}";
  // The barrel's radius is 1 + 1.5 t (1 - t), at its widest steps t = 2/5 and 3/5.
  const double barrel = 1.36;
  // The spout's lower edge at the middle of its second curve.
  const double lip = (0.825 + 3 * 0.88125 + 3 * 0.8625 + 0.8) / 8;
  return {
      {"torus", [](const ShapeLook& l) { return torus(1, 0.4, 40, 15, l); }, "SippTorus 1 0.4 40 15 $s", 1,
       600, 600, 41 * 15, 41 * 15, 41 * 16, V3d(-ring, -ring, 0.4 * tube_down),
       V3d(ring, ring, 0.4 * tube_up), true},
      // A tube of four: its corners lie at -45 degrees and so on; cylindrical and spherical v meet at the
      // wrap.
      {"square torus", [](const ShapeLook& l) { return torus(2, 1, 12, 4, l); }, "SippTorus 2 1 12 4 $s", 1,
       48, 48, 13 * 4, 13 * 4, 13 * 5, V3d(-2 - rim, -2 - rim, -rim), V3d(2 + rim, 2 + rim, rim), true},
      {"sphere", [](const ShapeLook& l) { return sphere(2, 8, l); }, "SippSphere 2 8 $s", 1, 8 * 2 + 8 * 2,
       8 * 3 + 2, 9 * 3 + 2 * 9, 9 + 2 * 2 * 9 + 2 * 9, 9 + 2 * 2 * 9 + 2 * 9, V3d(-2, -2, -2), V3d(2, 2, 2),
       true},
      {"ellipsoid", [](const ShapeLook& l) { return ellipsoid(V3d(1, 2, 3), 15, l); },
       "SippEllipsoid {1 2 3} 15 $s", 1, 2 * 16 + 16 * 6, 16 * 7 + 2, 17 * 7 + 2 * 17,
       17 + 6 * 2 * 17 + 2 * 17, 17 + 6 * 2 * 17 + 2 * 17, V3d(-1, -2, -3), V3d(1, 2, 3), true},
      {"octahedron", [](const ShapeLook& l) { return sphere(1, 4, l); }, "SippSphere 1 4 $s", 1, 8, 6,
       5 + 2 * 5, 5 + 2 * 5, 5 + 2 * 5, V3d(-1, -1, -1), V3d(1, 1, 1), true},
      {"cone", [](const ShapeLook& l) { return cone(1, 0, 4, 20, l); }, "SippCone 1 0 4 20 $s", 2, 40,
       21 + 21, 42 + 41, 42 + 41, 42 + 41, V3d(-1, -1, -2), V3d(1, 1, 2), true},
      {"cone on its tip", [](const ShapeLook& l) { return cone(0, 1, 4, 20, l); }, "SippCone 0 1 4 20 $s", 2,
       40, 21 + 21, 42 + 41, 42 + 41, 42 + 41, V3d(-1, -1, -2), V3d(1, 1, 2), true},
      {"truncated cone", [](const ShapeLook& l) { return cone(1, 0.4, 5, 20, l); }, "SippCone 1 0.4 5 20 $s",
       3, 60, 2 * 21 + 40, 2 * 42 + 42, 2 * 42 + 42, 2 * 42 + 42, V3d(-1, -1, -2.5), V3d(1, 1, 2.5), true},
      {"cylinder", [](const ShapeLook& l) { return cylinder(1, 3, 20, l); }, "SippCylinder 1 3 20 $s", 3, 60,
       2 * 21 + 40, 2 * 42 + 42, 2 * 42 + 42, 2 * 42 + 42, V3d(-1, -1, -1.5), V3d(1, 1, 1.5), true},
      {"concave prism", [](const ShapeLook& l) { return prism(k_arrow, 5, l); },
       "SippPrism {{0 -1} {2 -1} {1 0} {2 1} {0 1}} 5 $s", 7, 7, 30, 30, 30, 30, V3d(0, -1, -2.5),
       V3d(2, 1, 2.5), true},
      {"pentagon prism", [](const ShapeLook& l) { return prism(k_pentagon, 5, l); },
       "SippPrism {{0.5 -1} {-1 0.5} {1 1} {-1 2} {-2 0.5}} 5 $s", 7, 7, 30, 30, 30, 30, V3d(-2, -1, -2.5),
       V3d(1, 2, 2.5), true},
      {"block", [](const ShapeLook& l) { return block(V3d(1, 2, 3), l); }, "SippBlock {1 2 3} $s", 6, 6, 24,
       24, 24, 24, V3d(-0.5, -1, -1.5), V3d(0.5, 1, 1.5), true},
      {"cube", [](const ShapeLook& l) { return cube(2, l); }, "SippCube 2 $s", 6, 6, 24, 24, 24, 24,
       V3d(-1, -1, -1), V3d(1, 1, 1), true},
      {"patch", [](const ShapeLook& l) { return bezier_patches(flat_net(), first_indices(16), 5, l); },
       "SippBezierPatch 5 " + net + " {{0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15}} $s", 1, 25, 36, 36, 36, 36,
       V3d(0, 0, 0), V3d(3, 3, 1.5), false},
      {"revolved curve",
       [](const ShapeLook& l) { return bezier_rotcurves(k_barrel, first_indices(4), 5, l); },
       "SippBezierCurve 5 {{1 0 -1} {1.5 0 -0.3} {1.5 0 0.3} {1 0 1}} {{0 1 2 3}} $s", 1, 100, 6 * 20, 6 * 21,
       6 * 21, 6 * 21, V3d(-barrel, -barrel, -1), V3d(barrel, barrel, 1), false},
      // Textured: 5 x 17 vertices a curve, 5 x 5 a patch. The handle's last patch runs the other way: it
      // meets its neighbours in five places where the coordinates are the same.
      {"teapot", [](const ShapeLook& l) { return teapot(4, l); }, "SippTeapot 4 $s", 0, 28 * 16,
       13 * 16 + 8 * 16 + 1 + 2 * (8 * 9), 5 * 5 * 17 + 8 * 25 - 5, 5 * 5 * 17 + 8 * 25 - 5,
       5 * 5 * 17 + 8 * 25 - 5, V3d(-0.75, -0.5, 0), V3d(lip, 0.5, 0.75), false},
      // How many merge depends on the last bit of a sine: the first two corners, both at the lower pole,
      // freeze the tolerance at nearly nothing. Not counted (0).
      {"superquadric", [](const ShapeLook& l) { return superquadric(V3d(1, 2, 3), 1, 1, 0, l); },
       "SippSuperquadric {1 2 3} 1 1 0 $s", 1, 289, 0, 18 * 18, 18 * 18, 18 * 18, V3d(-1, -2, -3),
       V3d(1, 2, 3), false},
  };
}

}  // namespace farop::sipp
