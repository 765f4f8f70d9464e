// SPDX-License-Identifier: GPL-3.0-or-later
// Plane normals of polygons and the vertex normals averaged from them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scene/surface.h"

namespace farop {

/// Unit normal of the polygon's own plane, pointing to the side from which the corners run counter-clockwise;
/// robust for concave polygons and for degenerate first corners. Nothing for a degenerate polygon: |Newell
/// sum| <= 1e-12 times the squared extent, coordinates taken relative to the first corner. Source: Newell's
/// method as given by Sutherland, Sproull & Schumacker, "A Characterization of Ten Hidden-Surface
/// Algorithms", Computing Surveys 6(1), 1974.
std::optional<V3d> plane_normal(std::span<const V3d> positions, std::span<const std::uint32_t> corners);

/// Fills surface.averaged_normals: for every vertex the normalised sum of the unit plane normals of all
/// polygons of the surface that use it, those facing away included, so that shading does not depend on the
/// view. Vertices of polygons with given normals get an entry too, which nobody uses.
void average_normals(Surface& surface);

}  // namespace farop
