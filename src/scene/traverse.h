// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "scene/scene.h"

namespace farop {

/// A surface in one of its places in the tree. Valid during the visit.
struct SurfacePlacement {
  const Surface& surface;
  const M44d& local_to_world;  ///< row vectors
  std::uint32_t surface_id;  ///< surfaces count from 1 in order of first visit; an instance keeps its number
  std::uint32_t object_id;   ///< placed objects count from 1, an instance anew in each place; the root is 0
  std::size_t input;         ///< which child of the root it belongs to
};
using SurfaceVisitor = std::function<void(const SurfacePlacement&)>;

/// Calls `visit` for every surface of the tree, top-down in order, an instanced one once per place.
void for_each_surface(const Scene& scene, const SurfaceVisitor& visit);
/// The same for one object and its sub-objects; their numbers start with 0 for `object` itself.
void for_each_surface(const Object& object, const M44d& parent_to_world, const SurfaceVisitor& visit);

/// Totals over the tree; the root is not counted as an object, instances count as often as they are placed.
struct SceneTotals {
  std::uint64_t objects = 0, surfaces = 0, vertices = 0, polygons = 0, curved = 0;
  std::uint64_t memory_bytes = 0;  ///< of vertices, polygons and nodes; shared ones once
};
SceneTotals totals(const Scene& scene);

}  // namespace farop
