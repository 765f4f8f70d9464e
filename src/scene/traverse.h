// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "scene/scene.h"

namespace farop {

using SurfaceVisitor = std::function<void(const Surface&, const M44d& local_to_world)>;

/// Calls `visit` for every surface of the tree, top-down in order, an instanced one once per place, with its
/// accumulated matrix (row vectors).
void for_each_surface(const Scene& scene, const SurfaceVisitor& visit);
/// The same for one object and its sub-objects.
void for_each_surface(const Object& object, const M44d& parent_to_world, const SurfaceVisitor& visit);

/// Totals over the tree; the root is not counted as an object, instances count as often as they are placed.
struct SceneTotals {
  std::uint64_t objects = 0, surfaces = 0, vertices = 0, polygons = 0, curved = 0;
  std::uint64_t memory_bytes = 0;  ///< of vertices, polygons and nodes; shared ones once
};
SceneTotals totals(const Scene& scene);

}  // namespace farop
