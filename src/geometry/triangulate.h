// SPDX-License-Identifier: GPL-3.0-or-later
// Triangulation of planar polygons: ear clipping, smallest ear first, on exact predicates.
//
// Does:      cut a polygon of n corners into exactly n - 2 triangles over its own corners, all turning the
//            way the polygon turns, without overlap, their areas adding up to the polygon's. Besides simple
//            polygons it takes weakly simple ones, that is, all that a simple polygon becomes when it is
//            squeezed: repeated vertices, collinear runs, antennas without width, vertices and edges that
//            touch, the coincident bridge edges that clipping leaves on concave polygons, holes cut in by a
//            bridge. Simple polygons never get a triangle without area; a repeated vertex or the tip of an
//            antenna gets one, before all ears. Polygons that rounding has kept from being weakly simple
//            are cut as if it had not, to within 1e-6 of their largest coordinate at most.
// Does not:  add vertices; repair polygons that cross themselves (these get n - 2 triangles too, the same in
//            every run, but some overlap).
// Source:    Judd, smallest ear first, 1988. Held, "FIST: Fast Industrial-Strength Triangulation of
//            Polygons", Algorithmica 30, 2001: ears of unclean input. Chang, Erickson & Xu, "Detecting
//            Weakly Simple Polygons", SODA 2015: the order of coincident edges.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/math.h"

namespace farop {

/// Positions of three corners in the polygon, in its order.
using CornerTriangle = std::array<std::uint32_t, 3>;

struct TriangulateBuffers;

/// Buffers kept between calls, so that triangulating does not allocate. One per thread.
class TriangulateScratch {
 public:
  TriangulateScratch();
  ~TriangulateScratch();
  TriangulateScratch(const TriangulateScratch&) = delete;
  TriangulateScratch& operator=(const TriangulateScratch&) = delete;

  TriangulateBuffers& buffers() { return *buffers_; }

 private:
  std::unique_ptr<TriangulateBuffers> buffers_;
};

/// Triangulates one polygon.
///
/// corners    at least 3, in either orientation and any units; nearly planar
/// normal     the polygon's plane normal, any length and sign: the coordinate in which it is largest is left
///            out of all tests (ear sizes are distances in space)
/// triangles  replaced by corners.size() - 2 triangles, in the order they were cut; none for fewer than 3
///            corners
/// cost       O(n log n) for ordinary polygons, O(n^2) for the worst known
void triangulate(std::span<const V3d> corners, const V3d& normal, std::vector<CornerTriangle>& triangles,
                 TriangulateScratch& scratch);

namespace reference {

/// The definition of triangulate(), to be read and to be tested against: every step looks at all corners, in
/// O(n^3). (Polygons that cross themselves may come out differently.)
void triangulate(std::span<const V3d> corners, const V3d& normal, std::vector<CornerTriangle>& triangles);

}  // namespace reference
}  // namespace farop
