// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_notes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/limits.h"
#include "scene/traverse.h"

namespace farop::app {
namespace {

bool is_sipp(const InputSummary& input) {
  return input.format == "sipp";
}

/// The first word of a shader's description.
std::string kind_of(const Shader& shader) {
  const std::string text = shader.describe();
  return text.substr(0, text.find(' '));
}

std::string text_of(const V3d& v) {
  return fmt::format("({:.2f} {:.2f} {:.2f})", v.x, v.y, v.z);
}

std::string log_text(const Surface& s) {
  if (s.shader != nullptr)
    return fmt::format("SIPP surface with {} polygons ({})", s.polygons.size(), s.shader->describe());
  const Material& m = s.material;
  return fmt::format("NFF surface with {} polygons ({:.2f},{:.2f},{:.2f},{:g},{:.2f},{:.2f},{:.2f})",
                     s.polygons.size(), m.ka, m.ks, m.kd, m.shine, m.color.r, m.color.g, m.color.b);
}

}  // namespace

bool any_sipp(const Scene& scene) {
  return std::any_of(scene.inputs.begin(), scene.inputs.end(), is_sipp);
}

bool all_sipp(const Scene& scene) {
  return !scene.inputs.empty() && std::all_of(scene.inputs.begin(), scene.inputs.end(), is_sipp);
}

std::string light_text(const Light& light) {
  const Rgb c = light.color.value_or(Rgb{1, 1, 1});
  const std::string color = text_of({c.r, c.g, c.b});
  std::string text;
  switch (light.kind) {
    case LightKind::point:
      text = fmt::format("{} {}", text_of(light.position), color);
      break;
    case LightKind::directional:
      text = fmt::format("directional, towards {} {}", text_of(light.position), color);
      break;
    case LightKind::spot_sharp:
    case LightKind::spot_soft:
      text = fmt::format("{} spot, {} to {}, {:g} degrees{} {}",
                         light.kind == LightKind::spot_sharp ? "sharp" : "soft", text_of(light.position),
                         text_of(light.target), light.opening_degrees,
                         light.casts_shadows ? ", with shadows" : "", color);
      break;
  }
  return text + (light.active ? "" : ", switched off");
}

void log_scene(Console& console, const Scene& scene) {
  if (!console.verbose()) return;
  const char* format = any_sipp(scene) ? "SIPP" : "NFF";
  if (scene.view.background) console.log("{} background loaded", format);
  if (scene.view.from) console.log("{} view parameters loaded", format);
  for (const Light& light : scene.lights) console.log("{} light loaded {}", format, light_text(light));
  for_each_surface(scene,
                   [&](const SurfacePlacement& placement) { log_surface(console, placement.surface); });
}

void log_surface(Console& console, const Surface& surface) {
  if (console.verbose()) console.log("{}", log_text(surface));
}

DrawMode drawing_mode(Console& console, const std::string& option, const Scene& scene, bool internal) {
  if (!option.empty()) return draw_mode(option);
  const DrawMode mode = scene.drawing.mode.value_or(DrawMode::gouraud);
  if (internal || (mode != DrawMode::line && mode != DrawMode::phong)) return mode;
  console.notice(
      fmt::format("the scene asks for mode {}, which the internal rasterizer alone can draw: gouraud is used",
                  name_of(mode)));
  return DrawMode::gouraud;
}

int drawing_samples(const std::optional<int>& option, const Scene& scene) {
  return option.value_or(std::clamp(scene.drawing.samples.value_or(1), 1, k_max_samples));
}

std::map<std::string, std::uint64_t> shader_counts(const Scene& scene) {
  std::map<std::string, std::uint64_t> counts;
  for_each_surface(scene, [&](const SurfacePlacement& placement) {
    if (placement.surface.shader != nullptr) ++counts[kind_of(*placement.surface.shader)];
  });
  return counts;
}

void note_lost_patterns(Console& console, const Scene& scene) {
  std::set<std::string> kinds;
  for_each_surface(scene, [&](const SurfacePlacement& placement) {
    const Shader* shader = placement.surface.shader.get();
    if (shader != nullptr && shader->is_procedural()) kinds.insert(kind_of(*shader));
  });
  if (kinds.empty()) return;
  console.notice(
      fmt::format("shaders called per vertex show little of their pattern ({}); the internal rasterizer's "
                  "--mode phong calls them per pixel",
                  fmt::join(kinds, ", ")));
}

}  // namespace farop::app
