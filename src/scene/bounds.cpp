// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/bounds.h"

#include <algorithm>
#include <limits>

#include "scene/traverse.h"

namespace farop {

std::optional<Bounds> world_bounds(const Scene& scene) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Bounds box{V3d(inf, inf, inf), V3d(-inf, -inf, -inf)};
  bool any = false;
  for_each_surface(scene, [&](const SurfacePlacement& placement) {
    const bool moved = placement.local_to_world != M44d();
    for (const V3d& p : placement.surface.positions) {
      const V3d world = moved ? p * placement.local_to_world : p;
      for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], world[axis]);
        box.high[axis] = std::max(box.high[axis], world[axis]);
      }
      any = true;
    }
  });
  if (!any) return std::nullopt;
  return box;
}

}  // namespace farop
