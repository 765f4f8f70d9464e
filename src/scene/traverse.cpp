// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/traverse.h"

#include <unordered_map>
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

/// A walk through the tree, and the numbers it has given so far.
class Walk {
 public:
  explicit Walk(const SurfaceVisitor& visit) : visit_(visit) {}

  void object(const Object& object, const M44d& parent_to_world, std::size_t input) {
    const M44d local_to_world = object.to_parent * parent_to_world;
    const std::uint32_t object_id = objects_++;
    for (const auto& surface : object.surfaces) {
      visit_({*surface, local_to_world, id_of(surface), object_id, input});
    }
    const bool is_root = object_id == 0;
    for (std::size_t i = 0; i < object.children.size(); ++i) {
      this->object(*object.children[i], local_to_world, is_root ? i : input);
    }
  }

 private:
  std::uint32_t id_of(const std::shared_ptr<Surface>& surface) {
    return surfaces_.try_emplace(surface.get(), static_cast<std::uint32_t>(surfaces_.size() + 1))
        .first->second;
  }

  const SurfaceVisitor& visit_;
  std::uint32_t objects_ = 0;
  std::unordered_map<const Surface*, std::uint32_t> surfaces_;
};

}  // namespace

void for_each_surface(const Object& object, const M44d& parent_to_world, const SurfaceVisitor& visit) {
  Walk(visit).object(object, parent_to_world, 0);
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
