// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/sipp_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/error.h"

namespace farop::sipp {
namespace {

constexpr std::uint64_t k_countless = std::uint64_t{1} << 63;

std::uint64_t added(std::uint64_t a, std::uint64_t b) {
  return a < k_countless - b ? a + b : k_countless;  // both are at most 2^63
}

void check_copy(const Object& object, bool with_polygons) {
  const TreeSize size = tree_size(object);
  const auto refuse = [](std::uint64_t found, const char* what, std::uint64_t limit) {
    throw Error(ExitStatus::input,
                fmt::format("a copy would have {} {}; the limit is {}", found, what, limit),
                "make instances, which share what they show, instead of copies");
  };
  if (size.depth > k_max_depth) refuse(size.depth, "levels of sub-objects", k_max_depth);
  if (size.objects > k_max_copied_objects) refuse(size.objects, "objects", k_max_copied_objects);
  if (with_polygons && size.polygons > k_max_copied_polygons) {
    refuse(size.polygons, "polygons", k_max_copied_polygons);
  }
}

std::shared_ptr<Object> copy(const Object& object, bool copy_surfaces) {
  auto out = std::make_shared<Object>();
  out->name = object.name;
  out->surfaces = object.surfaces;
  if (copy_surfaces) {
    for (auto& surface : out->surfaces) surface = std::make_shared<Surface>(*surface);
  }
  out->children.reserve(object.children.size());
  for (const auto& child : object.children) out->children.push_back(copy(*child, copy_surfaces));
  return out;
}

}  // namespace

std::shared_ptr<Object> instance(const Object& object) {
  auto out = std::make_shared<Object>(object);
  out->to_parent = M44d();
  return out;
}

std::shared_ptr<Object> dup(const Object& object) {
  check_copy(object, false);
  return copy(object, false);
}

std::shared_ptr<Object> deep_dup(const Object& object) {
  check_copy(object, true);
  return copy(object, true);
}

TreeSize tree_size(const Object& object) {
  std::unordered_map<const Object*, TreeSize> known;
  struct Open {
    const Object* object;
    std::size_t next_child;
  };
  std::vector<Open> open{{&object, 0}};
  while (!open.empty()) {
    Open& top = open.back();
    if (top.next_child < top.object->children.size()) {
      const Object* const child = top.object->children[top.next_child++].get();
      if (!known.contains(child)) open.push_back({child, 0});
      continue;
    }
    TreeSize size{1, 0, 1};
    for (const auto& surface : top.object->surfaces)
      size.polygons = added(size.polygons, surface->polygons.size());
    for (const auto& child : top.object->children) {
      const TreeSize& below = known.at(child.get());
      size.objects = added(size.objects, below.objects);
      size.polygons = added(size.polygons, below.polygons);
      size.depth = std::max(size.depth, below.depth + 1);
    }
    known.emplace(top.object, size);
    open.pop_back();
  }
  return known.at(&object);
}

bool contains(const Object& tree, const Object& wanted) {
  std::unordered_set<const Object*> seen{&tree};
  std::vector<const Object*> open{&tree};
  while (!open.empty()) {
    const Object* const object = open.back();
    open.pop_back();
    if (object == &wanted) return true;
    for (const auto& child : object->children) {
      if (seen.insert(child.get()).second) open.push_back(child.get());
    }
  }
  return false;
}

}  // namespace farop::sipp
