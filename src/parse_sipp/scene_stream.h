// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as bytes, on its way from the process of the script to the one that asked for it. Same program on
// both sides: numbers are as they lie in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "scene/scene.h"

namespace farop::sipp {

using WriteBytes = std::function<void(const void* data, std::size_t size)>;
/// Fills `data` or throws.
using ReadBytes = std::function<void(void* data, std::size_t size)>;

/// `scene` as the script layer makes it: surfaces carry a ScriptShader or none. Shared objects and surfaces
/// are written once. The tree has no cycles.
void write_scene(const Scene& scene, const WriteBytes& write);

/// The same tree, with shaders that shade and the materials that are their nearest. What comes from the other
/// side is not trusted: a wrong count, index or flag, or arrays of more than `most_bytes` together, throw
/// std::runtime_error.
Scene read_scene(const ReadBytes& read, std::uint64_t most_bytes);

}  // namespace farop::sipp
