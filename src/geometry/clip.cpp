// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/clip.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace farop {
namespace {

enum class Plane : std::uint8_t { hither, yon, left, right, bottom, top };
constexpr std::array k_planes{Plane::hither, Plane::yon,    Plane::left,
                              Plane::right,  Plane::bottom, Plane::top};

/// The coordinate that a plane limits, and the limit at a point. A point is inside while coordinate <=
/// limit (>= for hither, left and bottom). Comparing instead of subtracting makes "on the plane" exact.
struct Reach {
  double coordinate;
  double limit;
  bool is_lower;

  bool is_inside() const { return is_lower ? coordinate >= limit : coordinate <= limit; }
  double distance() const { return is_lower ? coordinate - limit : limit - coordinate; }
};

Reach reach(const V3d& p, Plane plane, const Frustum& frustum) {
  switch (plane) {
    case Plane::hither:
      return {p.z, frustum.hither, true};
    case Plane::yon:
      return {p.z, frustum.yon, false};
    case Plane::left:
      return {p.x, -(p.z * frustum.tan_x), true};
    case Plane::right:
      return {p.x, p.z * frustum.tan_x, false};
    case Plane::bottom:
      return {p.y, -(p.z * frustum.tan_y), true};
    case Plane::top:
      break;
  }
  return {p.y, p.z * frustum.tan_y, false};
}

bool is_inside(const V3d& p, Plane plane, const Frustum& frustum) {
  return reach(p, plane, frustum).is_inside();
}

/// Bit k is set when the point is outside plane k.
unsigned outcode(const V3d& p, const Frustum& frustum) {
  unsigned code = 0;
  for (const Plane plane : k_planes) {
    if (!is_inside(p, plane, frustum)) code |= 1u << static_cast<unsigned>(plane);
  }
  return code;
}

/// Weighted mean that never leaves the range of its two values. Both weights are taken from their own
/// endpoint: with a + t (b - a) an endpoint 1e30 away would wipe out the near one.
double mix(double a, double weight_a, double b, double weight_b) {
  const auto [low, high] = std::minmax(a, b);
  return std::clamp(a * weight_a + b * weight_b, low, high);
}

V3d mix(const V3d& a, double weight_a, const V3d& b, double weight_b) {
  return {mix(a.x, weight_a, b.x, weight_b), mix(a.y, weight_a, b.y, weight_b),
          mix(a.z, weight_a, b.z, weight_b)};
}

/// Puts the coordinate that a plane limits right onto the limit.
void move_onto(V3d& p, Plane plane, const Frustum& frustum) {
  const double limit = reach(p, plane, frustum).limit;
  switch (plane) {
    case Plane::hither:
    case Plane::yon:
      p.z = limit;
      break;
    case Plane::left:
    case Plane::right:
      p.x = limit;
      break;
    case Plane::bottom:
    case Plane::top:
      p.y = limit;
      break;
  }
}

/// The vertex where an edge leaves the volume. A function of the inside and the outside end, not of their
/// order in the polygon and not of the rest of it: this is what keeps seams closed. The normal is left
/// unnormalised, because a later plane may cut again.
EyeVertex cut(const EyeVertex& inside, const EyeVertex& outside, Plane plane, const Frustum& frustum) {
  const double inside_distance = reach(inside.position, plane, frustum).distance();
  const double outside_distance = -reach(outside.position, plane, frustum).distance();
  const double length = inside_distance + outside_distance;
  const double inside_weight = outside_distance / length;
  const double outside_weight = inside_distance / length;
  EyeVertex made;
  made.position = mix(inside.position, inside_weight, outside.position, outside_weight);
  made.normal = mix(inside.normal, inside_weight, outside.normal, outside_weight);
  if (made.normal == V3d(0)) made.normal = inside.normal;
  made.texture = mix(inside.texture, inside_weight, outside.texture, outside_weight);
  move_onto(made.position, plane, frustum);
  // An edge inside another plane must not be taken out of it by rounding. Depth comes first in k_planes, as
  // the other limits depend on it.
  for (const Plane other : k_planes) {
    if (other != plane && !is_inside(made.position, other, frustum) &&
        is_inside(inside.position, other, frustum) && is_inside(outside.position, other, frustum)) {
      move_onto(made.position, other, frustum);
    }
  }
  return made;
}

/// One step of the method: what of `polygon` lies inside one plane, appended to `kept`.
void clip_to_plane(const std::vector<EyeVertex>& polygon, Plane plane, const Frustum& frustum,
                   std::vector<EyeVertex>& kept) {
  // A vertex cut right at the inside end (which then lies on the plane, or as good as) would only repeat it.
  const auto append_cut = [&](const EyeVertex& inside, const EyeVertex& outside) {
    const EyeVertex made = cut(inside, outside, plane, frustum);
    if (made.position != inside.position) kept.push_back(made);
  };
  const EyeVertex* previous = &polygon.back();
  bool previous_inside = is_inside(previous->position, plane, frustum);
  for (const EyeVertex& current : polygon) {
    const bool current_inside = is_inside(current.position, plane, frustum);
    if (previous_inside && !current_inside) append_cut(*previous, current);
    if (!previous_inside && current_inside) append_cut(current, *previous);
    if (current_inside) kept.push_back(current);
    previous = &current;
    previous_inside = current_inside;
  }
}

bool has_three_different_positions(const std::vector<EyeVertex>& polygon) {
  const auto differs_from = [](const V3d& p) { return [&p](const EyeVertex& v) { return v.position != p; }; };
  if (polygon.empty()) return false;
  const V3d& first = polygon.front().position;
  const auto second = std::ranges::find_if(polygon, differs_from(first));
  if (second == polygon.end()) return false;
  return std::any_of(second, polygon.end(), [&](const EyeVertex& v) {
    return v.position != first && v.position != second->position;
  });
}

}  // namespace

ClipResult clip_to_frustum(std::vector<EyeVertex>& polygon, const Frustum& frustum, ClipScratch& scratch) {
  unsigned outside_any = 0;
  unsigned outside_all = ~0u;
  for (const EyeVertex& vertex : polygon) {
    const unsigned code = outcode(vertex.position, frustum);
    outside_any |= code;
    outside_all &= code;
  }
  if (outside_any == 0) return ClipResult::inside;
  if (outside_all != 0) return ClipResult::outside;

  // New vertices lie between old ones, in spite of rounding: planes that cut nothing off the original cut
  // nothing later.
  for (const Plane plane : k_planes) {
    if ((outside_any >> static_cast<unsigned>(plane) & 1u) == 0) continue;
    scratch.vertices.clear();
    clip_to_plane(polygon, plane, frustum, scratch.vertices);
    polygon.swap(scratch.vertices);
    if (!has_three_different_positions(polygon)) return ClipResult::outside;
  }
  for (EyeVertex& vertex : polygon) {
    if (vertex.source == k_clip_made) vertex.normal.normalize();
  }
  return ClipResult::partly;
}

}  // namespace farop
