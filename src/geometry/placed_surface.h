// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"
#include "scene/traverse.h"

namespace farop {

/// A surface in its place: the matrices its polygons need. Row vectors; valid as long as the scene.
struct PlacedSurface {
  PlacedSurface(const SurfacePlacement& placement, const M44d& world_to_eye, const V3d& eye_world);

  /// `local` moved by the directional part of `matrix`, unit length; zero stays zero.
  static V3d direction(const V3d& local, const M44d& matrix) {
    V3d out;
    matrix.multDirMatrix(local, out);
    return out.normalized();
  }

  /// Where the normals of a polygon's corners come from, parallel to the positions; nullptr: from its plane.
  const std::vector<V3d>* vertex_normals(bool has_given_normals) const {
    if (has_given_normals) return &surface.normals;
    return surface.averaged_normals.empty() ? nullptr : &surface.averaged_normals;
  }

  const Surface& surface;
  std::uint32_t surface_id, object_id;
  std::size_t input;
  M44d local_to_eye;
  M44d normal_to_eye;         ///< of planes
  M44d vertex_normal_to_eye;  ///< of vertex normals, by the surface's rule
  V3d eye_local;
  bool flattened = false;  ///< the matrix leaves no volume: no side to see
  bool mirrored = false;   ///< fronts run clockwise once they have been moved
};

}  // namespace farop
