// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/placed_surface.h"

namespace farop {

PlacedSurface::PlacedSurface(const SurfacePlacement& placement, const M44d& world_to_eye,
                             const V3d& eye_world)
    : surface(placement.surface),
      surface_id(placement.surface_id),
      object_id(placement.object_id),
      input(placement.input),
      local_to_eye(placement.local_to_world * world_to_eye) {
  const M44d& local_to_world = placement.local_to_world;
  if (surface.normal_rule == NormalRule::sipp) vertex_normal_to_eye = local_to_eye;
  if (local_to_world == M44d()) {
    eye_local = eye_world;
    normal_to_eye = world_to_eye;  // orthonormal: its own inverse transpose
  } else {
    const double volume = local_to_world.determinant();
    flattened = volume == 0;
    mirrored = volume < 0;
    eye_local = eye_world * local_to_world.inverse();
    normal_to_eye = local_to_eye.inverse().transposed();
  }
  if (surface.normal_rule == NormalRule::nff) vertex_normal_to_eye = normal_to_eye;
}

}  // namespace farop
