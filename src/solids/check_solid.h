// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the polygons of an object are the boundary of a solid, as the scan-line algorithm for solids needs
// it.
//
// What is asked, in this order: every polygon has an area; the surface is closed; every edge lies between two
// polygons and every vertex in one ring of them (a 2-manifold); neighbours run along their edge in opposite
// directions; the surface does not cut through or touch itself; front sides look outwards (with hollows: away
// from the material). Polygons of all surfaces and sub-objects count together; corners at equal positions are
// one vertex, and nothing else is: a gap of one unit in the last place is a gap.
// Combinatorics are exact. Geometry is judged on the triangles that the geometry stage would draw, with exact
// predicates (CGAL, Polygon Mesh Processing).
// Source: A. A. G. Requicha, "Representations for Rigid Solids: Theory, Methods, and Systems", Computing
// Surveys 12(4), 1980; M. Mäntylä, "An Introduction to Solid Modeling", Computer Science Press, 1988.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/math.h"
#include "scene/scene.h"

namespace farop {

/// In the order in which they are asked; each makes sense only where those before it hold.
enum class SolidProperty {
  proper_polygons,   ///< at least 3 different corners that are not on one line
  closed,            ///< no edge with a polygon on one side only
  manifold,          ///< no edge with more than two polygons, no vertex where several rings of polygons meet
  oriented,          ///< no two neighbours that run along their edge in the same direction
  not_intersecting,  ///< no two polygons that meet elsewhere than in a common edge or vertex
  outward            ///< front sides look outwards
};

/// "closed", "manifold" ...: the word for messages.
const char* name_of(SolidProperty property);

/// The first property that fails, and where.
struct SolidFlaw {
  SolidProperty property = SolidProperty::closed;
  std::uint64_t polygon = 0;                   ///< counted from 0 over the object, in the order of drawing
  std::optional<std::uint64_t> other_polygon;  ///< the second one, where two are at odds
  V3d position{0, 0, 0};                       ///< of a corner involved; coordinates as in SolidReport
};

/// "not closed: polygon 12 has no neighbour over an edge, at (1, 0, 0.5)"
std::string describe(const SolidFlaw& flaw);

/// Positions are those of the object's parent.
struct SolidReport {
  std::uint64_t polygons = 0, edges = 0, vertices = 0;  ///< after merging
  std::uint64_t shells = 0;                             ///< connected parts of the surface; of solids only
  std::optional<SolidFlaw> flaw;

  bool ok() const { return !flaw && polygons > 0; }
};

/// Spheres and cones that are not polygons yet are not looked at: tessellate() first. An object without
/// polygons is no solid and has no flaw. Cost: O(n log n).
SolidReport check_solid(const Object& object);

}  // namespace farop
