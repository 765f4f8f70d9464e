// SPDX-License-Identifier: GPL-3.0-or-later
// Sutherland-Hodgman clipping of planar polygons against the viewing frustum.
//
// Does:      clip one polygon, convex or concave, in eye space (x right, y up, z along the view direction);
//            interpolate every attribute linearly; give an edge that two polygons share the same new vertex
//            bit for bit, whichever way each of them runs (seams stay closed); leave every vertex inside all
//            planes to the last bit.
// Does not:  split a concave result into several loops (coincident bridge edges along the planes are kept,
//            as the method is known to do); remove collinear vertices; cull; project.
// Source:    Sutherland & Hodgman, "Reentrant Polygon Clipping", CACM 17(1), 1974.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"

namespace farop {

/// EyeVertex::source of a vertex that clipping made.
constexpr std::uint32_t k_clip_made = 0xFFFFFFFFu;

/// One corner of a polygon on its way through the geometry stage.
struct EyeVertex {
  V3d position;                        ///< eye space, scene units; components up to 1e150 in size
  V3d normal;                          ///< eye space, unit length
  std::uint32_t source = k_clip_made;  ///< index of the stored corner it comes from, or k_clip_made
  V3d texture{0, 0, 0};                ///< texture coordinates
};

/// The visible volume: hither <= z <= yon, |x| <= z tan_x, |y| <= z tan_y.
struct Frustum {
  double tan_x = 1, tan_y = 1;  ///< tangents of half the angles of view, > 0
  double hither = 1;            ///< > 0
  double yon = 2;               ///< > hither; may be +infinity
};

enum class ClipResult : std::uint8_t {
  inside,   ///< nothing was cut; the polygon is unchanged
  partly,   ///< the polygon now holds what is left of it
  outside,  ///< fewer than three different vertices are left; the polygon holds nothing of use
};

/// Buffer kept between calls, so that clipping does not allocate.
struct ClipScratch {
  std::vector<EyeVertex> vertices;
};

/// Cuts off what lies outside: against hither, yon, left, right, bottom, top, in this order. A vertex on a
/// plane is inside. Attributes of new vertices are interpolated linearly along the edge, normals then
/// normalised.
ClipResult clip_to_frustum(std::vector<EyeVertex>& polygon, const Frustum& frustum, ClipScratch& scratch);

}  // namespace farop
