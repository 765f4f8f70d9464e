// SPDX-License-Identifier: GPL-3.0-or-later
// What is said about the shaders and lights of a scene, and what a scene's format decides.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "console.h"
#include "core/draw_mode.h"
#include "scene/scene.h"

namespace farop::app {

/// SIPP scenes bring their own rules: no light of the program's, transparency that adds up.
bool any_sipp(const Scene& scene);
bool all_sipp(const Scene& scene);

/// The log of one input, in the words of the 1997 system: background, view, lights, surfaces (--verbose).
void log_scene(Console& console, const Scene& scene);
/// Its line about a surface, or about a part of one.
void log_surface(Console& console, const Surface& surface);

/// One line about a light: kind, place, colour.
std::string light_text(const Light& light);

/// What `--mode` says, else what the scene asks for, else gouraud. line and phong are the internal
/// rasterizer's: a scene that asks for them elsewhere gets gouraud, with a notice.
DrawMode drawing_mode(Console& console, const std::string& option, const Scene& scene, bool internal);

/// Degree of super-sampling: the option, else the scene's (limited to what we draw), else 1.
int drawing_samples(const std::optional<int>& option, const Scene& scene);

/// How many surfaces in how many places have a shader of each kind ("basic", "wood" ...); those without are
/// left out.
std::map<std::string, std::uint64_t> shader_counts(const Scene& scene);

/// One notice that names the shaders whose patterns are lost when they are called per vertex.
void note_lost_patterns(Console& console, const Scene& scene);

}  // namespace farop::app
