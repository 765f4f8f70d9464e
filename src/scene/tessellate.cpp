// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/tessellate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/error.h"
#include "scene/surface_builder.h"

namespace farop {
namespace {

constexpr double k_pi = std::numbers::pi;
constexpr int k_resolution_without_camera = 3;
constexpr int k_max_auto_resolution = 64;

/// Length without overflow on the way, so that huge and tiny primitives keep their shape.
double length(const V3d& v) {
  return std::hypot(v.x, v.y, v.z);
}

V3d unit(const V3d& v) {
  const double l = length(v);
  return l > 0 ? v / l : v;
}

/// Hands over triangles given for the outside; turns them round for primitives that are seen from inside.
void emit_facing(bool inside_visible, const TessellationCorner& a, const TessellationCorner& b,
                 const TessellationCorner& c, const TriangleFunction& emit) {
  if (!inside_visible) {
    emit({a, b, c});
    return;
  }
  const auto turned = [](const TessellationCorner& corner) {
    return TessellationCorner{corner.position, -corner.normal};
  };
  emit({turned(c), turned(b), turned(a)});
}

/// Directions of one face of the cube, seen from the sphere's centre, in steps of equal angle: (R+1)^2 unit
/// vectors, row u, column v. Equal to normalise((cos a_u, 0, -sin a_u) x (0, cos a_v, sin a_v)), a_k = pi/4
/// (2k/R - 1), divided by cos a_u cos a_v first: in this form edges and corners of the six faces agree to the
/// last bit.
std::vector<V3d> cube_face_directions(int resolution) {
  const auto steps = static_cast<std::size_t>(resolution) + 1;
  std::vector<double> tangent(steps);
  for (int k = 0; k <= resolution; ++k)
    tangent[static_cast<std::size_t>(k)] = std::tan(k_pi / 4 * (2.0 * k - resolution) / resolution);
  tangent.front() = -1;
  tangent.back() = 1;

  std::vector<V3d> directions;
  directions.reserve(steps * steps);
  for (const double u : tangent)
    for (const double v : tangent) directions.push_back(V3d(u, -v, 1) / std::sqrt((u * u + v * v) + 1));
  return directions;
}

/// Turns the grid from one face of the cube to the next; six turns visit all faces.
void turn_to_face(int face, std::vector<V3d>& directions) {
  for (V3d& d : directions) {
    switch (face % 3) {
      case 0:
        d = V3d(-d.z, d.y, d.x);
        break;
      case 1:
        d = V3d(-d.y, d.x, d.z);
        break;
      default:
        d = V3d(d.x, -d.z, d.y);
        break;
    }
  }
}

/// A direction across the axis w, unit length.
V3d across(const V3d& w) {
  const V3d by_z = w.cross(V3d(0, 0, 1));
  if (length(by_z) >= 1e-6) return unit(by_z);
  // Along z, or shorter than the threshold: then the better of two (SPD takes the second).
  const V3d by_x = w.cross(V3d(1, 0, 0));
  return unit(length(by_x) >= length(by_z) ? by_x : by_z);
}

/// R such that a circle of this radius, drawn as a polygon of 4 R sides, is off by half a pixel at most.
int resolution_for(double radius, double distance, const DetailView& view) {
  const double clear_distance = std::max(distance - radius, radius / 16);
  const double pixels = radius * (view.rows - 1) / (2 * view.vertical_tangent * clear_distance);
  const double resolution = std::ceil(0.785 * std::sqrt(pixels));
  if (!(resolution > 1)) return 1;  // also what is not a number
  return static_cast<int>(std::min<double>(resolution, k_max_auto_resolution));
}

double distance_to_segment(const V3d& point, const V3d& a, const V3d& b) {
  const V3d axis = b - a;
  const double t = std::clamp((point - a).dot(axis) / axis.dot(axis), 0.0, 1.0);
  return length(point - (a + axis * t));
}

/// Largest length of a local unit axis after `m`: the factor for radii, exact for similarities.
double scale_of(const M44d& m) {
  double scale = 0;
  for (int axis = 0; axis < 3; ++axis)
    scale = std::max(scale, length(V3d(m[axis][0], m[axis][1], m[axis][2])));
  return scale;
}

int auto_resolution_placed(const CurvedPrimitive& primitive, const M44d& local_to_world,
                           const DetailView& view) {
  const double scale = scale_of(local_to_world);
  if (primitive.kind == CurvedPrimitive::Kind::sphere) {
    Sphere sphere = primitive.sphere;
    sphere.center = sphere.center * local_to_world;
    sphere.radius *= scale;
    return auto_resolution(sphere, view);
  }
  Cone cone = primitive.cone;
  cone.base = cone.base * local_to_world;
  cone.apex = cone.apex * local_to_world;
  cone.base_radius *= scale;
  cone.apex_radius *= scale;
  return auto_resolution(cone, view);
}

/// Every surface that has curved primitives, once, with a resolution for each of them.
using ResolutionsOfSurface = std::unordered_map<Surface*, std::vector<int>>;

/// Walks over all placements: of an instanced surface the placement that needs most decides.
class ResolutionCollector {
 public:
  ResolutionCollector(Scene& scene, const Detail& detail) : scene_(scene), detail_(detail) {}

  ResolutionsOfSurface collect() {
    visit(scene_.root, M44d());
    return std::move(resolutions_);
  }

 private:
  void visit(const Object& object, const M44d& parent_to_world) {
    const M44d local_to_world = object.to_parent * parent_to_world;
    for (const auto& surface : object.surfaces)
      if (!surface->curved.empty()) visit(*surface, local_to_world);
    for (const auto& child : object.children) visit(*child, local_to_world);
  }

  void visit(Surface& surface, const M44d& local_to_world) {
    std::vector<int>& resolutions =
        resolutions_.try_emplace(&surface, surface.curved.size(), 0).first->second;
    for (std::size_t i = 0; i < surface.curved.size(); ++i) {
      const CurvedPrimitive& primitive = surface.curved[i];
      const int resolution = resolution_of(primitive, local_to_world);
      resolutions[i] = std::max(resolutions[i], resolution);
      if (resolution == 0)
        ++(primitive.kind == CurvedPrimitive::Kind::sphere ? scene_.spheres_skipped : scene_.cones_skipped);
    }
  }

  int resolution_of(const CurvedPrimitive& primitive, const M44d& local_to_world) const {
    if (detail_.fixed) return *detail_.fixed;
    if (!detail_.view) return k_resolution_without_camera;
    return auto_resolution_placed(primitive, local_to_world, *detail_.view);
  }

  Scene& scene_;
  const Detail& detail_;
  ResolutionsOfSurface resolutions_;
};

std::uint64_t triangle_count(const Surface& surface, const std::vector<int>& resolutions) {
  std::uint64_t triangles = 0;
  for (std::size_t i = 0; i < surface.curved.size(); ++i) {
    const auto r = static_cast<std::uint64_t>(resolutions[i]);
    triangles += surface.curved[i].kind == CurvedPrimitive::Kind::sphere ? 12 * r * r : 8 * r;
  }
  return triangles;
}

/// The same surface with every curved primitive replaced, in its place, by triangles (resolution 0: by
/// nothing).
Surface tessellated(const Surface& surface, const std::vector<int>& resolutions) {
  SurfaceBuilder builder(surface.material);
  const TriangleFunction add_triangle = [&](const TessellationCorner(&triangle)[3]) {
    builder.begin_polygon(true);
    for (const TessellationCorner& corner : triangle) builder.add_corner(corner.position, corner.normal);
    builder.end_polygon();
  };

  std::uint64_t cone_tip_triangles = 0;
  std::size_t next = 0;
  const auto add_curved_before = [&](std::uint64_t polygon) {
    for (; next < surface.curved.size() && surface.curved[next].after_polygons <= polygon; ++next) {
      if (resolutions[next] == 0) continue;
      const CurvedPrimitive& primitive = surface.curved[next];
      if (primitive.kind == CurvedPrimitive::Kind::sphere) {
        tessellate(primitive.sphere, resolutions[next], add_triangle);
      } else {
        tessellate(primitive.cone, resolutions[next], add_triangle);
        // At a tip every quadrilateral strip of the construction has one triangle without area.
        const bool pointed = primitive.cone.base_radius == 0 || primitive.cone.apex_radius == 0;
        if (pointed) cone_tip_triangles += 4 * static_cast<std::uint64_t>(resolutions[next]);
      }
    }
  };

  std::uint64_t index = 0;
  for (const PolygonView polygon : surface.polygons) {
    add_curved_before(index++);
    builder.begin_polygon(polygon.has_given_normals);
    for (const std::uint32_t corner : polygon.corners) {
      if (polygon.has_given_normals)
        builder.add_corner(surface.positions[corner], surface.normals[corner]);
      else
        builder.add_corner(surface.positions[corner]);
    }
    builder.end_polygon();
  }
  add_curved_before(index);
  Surface done = builder.take();
  done.cone_tip_triangles = cone_tip_triangles;
  return done;
}

}  // namespace

void tessellate(const Sphere& sphere, int resolution, const TriangleFunction& emit) {
  assert(resolution >= 1 && resolution <= k_max_detail);
  const auto r = static_cast<std::size_t>(resolution);
  std::vector<V3d> directions = cube_face_directions(resolution);
  const auto corner = [&](std::size_t u, std::size_t v) {
    const V3d& normal = directions[u * (r + 1) + v];
    return TessellationCorner{sphere.center + normal * sphere.radius, normal};
  };
  for (int face = 0; face < 6; ++face) {
    turn_to_face(face, directions);
    for (std::size_t u = 0; u < r; ++u) {
      for (std::size_t v = 0; v < r; ++v) {
        const TessellationCorner q0 = corner(u, v), q1 = corner(u, v + 1);
        const TessellationCorner q2 = corner(u + 1, v + 1), q3 = corner(u + 1, v);
        emit_facing(sphere.inside_visible, q0, q1, q2, emit);
        emit_facing(sphere.inside_visible, q2, q3, q0, emit);
      }
    }
  }
}

void tessellate(const Cone& cone, int resolution, const TriangleFunction& emit) {
  assert(resolution >= 1 && resolution <= k_max_detail);
  const V3d w = cone.apex - cone.base;
  const double height = length(w);
  const V3d axis = w / height;
  const V3d start = across(w);
  const V3d quarter_turned = axis.cross(start);
  const double slope = cone.base_radius - cone.apex_radius;

  const int sides = 4 * resolution;
  struct Side {
    TessellationCorner apex, base;
  };
  const auto side = [&](int i) {
    // The last side is the first: angles wrap, so that the seam closes to the last bit.
    const double angle = 2 * k_pi * (i % sides) / sides;
    const V3d outward = start * std::cos(angle) + quarter_turned * std::sin(angle);
    const V3d normal = slope == 0 ? outward : unit(outward * height + axis * slope);
    return Side{{cone.apex + outward * cone.apex_radius, normal},
                {cone.base + outward * cone.base_radius, normal}};
  };

  Side previous = side(0);
  for (int i = 1; i <= sides; ++i) {
    const Side current = side(i);
    emit_facing(cone.inside_visible, current.apex, previous.apex, previous.base, emit);
    emit_facing(cone.inside_visible, current.base, current.apex, previous.base, emit);
    previous = current;
  }
}

int auto_resolution(const Sphere& sphere, const DetailView& view) {
  return resolution_for(sphere.radius, length(view.eye - sphere.center), view);
}

int auto_resolution(const Cone& cone, const DetailView& view) {
  return resolution_for(std::max(cone.base_radius, cone.apex_radius),
                        distance_to_segment(view.eye, cone.base, cone.apex), view);
}

void tessellate_scene(Scene& scene, const Detail& detail) {
  const ResolutionsOfSurface surfaces = ResolutionCollector(scene, detail).collect();
  std::uint64_t triangles = 0;
  for (const auto& [surface, resolutions] : surfaces) triangles += triangle_count(*surface, resolutions);
  if (triangles > k_max_tessellated_triangles) {
    throw Error(ExitStatus::surroundings,
                fmt::format("the spheres and cones would become {} triangles, more than {}", triangles,
                            k_max_tessellated_triangles),
                "choose fewer with --detail N, or leave them out with --detail 0");
  }
  for (const auto& [surface, resolutions] : surfaces) *surface = tessellated(*surface, resolutions);
}

}  // namespace farop
