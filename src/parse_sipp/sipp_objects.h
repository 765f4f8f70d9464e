// SPDX-License-Identifier: GPL-3.0-or-later
// What SIPP does with objects beside moving them: copies, and questions about trees.
#pragma once

#include <cstdint>
#include <memory>

#include "scene/scene.h"

namespace farop::sipp {

/// A new node with the identity matrix that shares surfaces and sub-objects with `object`.
std::shared_ptr<Object> instance(const Object& object);

/// A copy of the tree below `object`: nodes are new, surfaces shared. All matrices of the copy are
/// identities, also those of sub-objects, as in SIPP 3.1. A sub-object that is reached twice is copied twice.
/// Throws Error(ExitStatus::input) for more than k_max_copied_objects nodes.
std::shared_ptr<Object> dup(const Object& object);

/// As dup(), with surfaces of its own: vertices and polygons are copied, shaders shared.
/// Throws Error(ExitStatus::input) also for more than k_max_copied_polygons polygons.
std::shared_ptr<Object> deep_dup(const Object& object);

/// Some gigabytes: sub-objects shared over a few dozen levels make trees that no memory holds.
constexpr std::uint64_t k_max_copied_objects = 10'000'000;
constexpr std::uint64_t k_max_copied_polygons = 100'000'000;

/// A tree as it is drawn: everything counts as often as it is placed; numbers stop at 2^63.
struct TreeSize {
  std::uint64_t objects = 0;  ///< the top one included
  std::uint64_t polygons = 0;
  std::uint64_t depth = 0;  ///< levels, 1 for an object without sub-objects
};
/// Looks at every node once, however often it is shared. No recursion: safe for trees of any depth. The tree
/// has no cycles.
TreeSize tree_size(const Object& object);

/// `wanted` is `tree` or hangs somewhere below it.
bool contains(const Object& tree, const Object& wanted);

/// Levels that trees are allowed to have: walking and freeing them is recursive.
constexpr std::uint64_t k_max_depth = 2000;

}  // namespace farop::sipp
