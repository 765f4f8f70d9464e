// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/traverse.h"

#include <unordered_set>

namespace farop {
namespace {

void count_object(const Object& object, SceneTotals& sums, std::unordered_set<const void*>& seen) {
  if (seen.insert(&object).second) {
    sums.memory_bytes += sizeof(Object) + object.surfaces.capacity() * sizeof(object.surfaces[0]) +
                         object.children.capacity() * sizeof(object.children[0]);
  }
  for (const auto& surface : object.surfaces) {
    ++sums.surfaces;
    sums.vertices += surface->positions.size();
    sums.polygons += surface->polygons.size();
    sums.curved += surface->curved.size();
    if (seen.insert(surface.get()).second) sums.memory_bytes += surface->memory_bytes();
  }
  for (const auto& child : object.children) {
    ++sums.objects;
    count_object(*child, sums, seen);
  }
}

}  // namespace

void for_each_surface(const Object& object, const M44d& parent_to_world, const SurfaceVisitor& visit) {
  const M44d local_to_world = object.to_parent * parent_to_world;
  for (const auto& surface : object.surfaces) visit(*surface, local_to_world);
  for (const auto& child : object.children) for_each_surface(*child, local_to_world, visit);
}

void for_each_surface(const Scene& scene, const SurfaceVisitor& visit) {
  for_each_surface(scene.root, M44d(), visit);
}

SceneTotals totals(const Scene& scene) {
  SceneTotals sums;
  std::unordered_set<const void*> seen;
  count_object(scene.root, sums, seen);
  return sums;
}

}  // namespace farop
