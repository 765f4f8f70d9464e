// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "core/error.h"
#include "core/word_reader.h"
#include "drawing_recorder.h"
#include "geometry/pipeline.h"
#include "options.h"
#include "parse_nff/parse_nff.h"
#include "parse_sipp/parse_sipp.h"
#include "program_files.h"
#include "scene/merge.h"
#include "scene/tessellate.h"
#include "scene_notes.h"
#include "spd/spd.h"

namespace farop::app {
namespace {

namespace fs = std::filesystem;
using conformance::Drawing;
using conformance::Level;
using conformance::SceneSource;

/// A square picture of a scene.
struct Shot {
  int pixels = 128;
  bool triangles = false;
  std::int64_t depths = 65536;  ///< ZRES
};

Drawing picture_of(Scene scene, const Shot& shot) {
  DiagnosticList unheard;
  Camera camera = complete_camera(scene.view, unheard);
  // Depths that differ are to come out different: the less is left open, the more is judged.
  camera.fit_depth = true;
  camera.hither = std::max(camera.hither, 0.01 * (camera.at - camera.from).length());
  Viewport viewport;
  viewport.resolution = {shot.pixels, shot.pixels, shot.depths, 256};
  const ViewTangents tangents = view_tangents(camera, viewport);
  tessellate_scene(scene, {std::nullopt, DetailView{camera.from, tangents.y, shot.pixels}});
  GeometryOptions options;
  options.triangles = shot.triangles;
  options.two_sided = scene.drawing.two_sided.value_or(false);
  options.light_intensity = light_intensity(SceneOptions(), scene.lights.size());
  options.light_at_eye = !any_sipp(scene);
  const GeometrySetup setup = prepare_geometry(scene, camera, viewport, options);
  DrawingRecorder recorder;
  GeometryClocks clocks;
  run_geometry(scene, setup, options, recorder, clocks);
  return std::move(recorder.drawing);
}

[[noreturn]] void cannot_read(const std::string& name, const DiagnosticList& said) {
  const std::string why = said.items.empty() ? "" : to_text(said.items.back());
  throw Error(ExitStatus::internal, fmt::format("the scene '{}' cannot be read: {}", name, why));
}

Drawing draw_computed(const SpdRequest& request, const Shot& shot) {
  std::string text;
  write_spd(request, [&text](std::string_view block) { text += block; });
  WordReader reader(text, request.name);
  DiagnosticList said;
  std::optional<Scene> scene = parse_nff(reader, said);
  if (!scene) cannot_read(request.name, said);
  return picture_of(std::move(*scene), shot);
}

Drawing draw_script(const std::string& file, const Shot& shot) {
  DiagnosticList said;
  std::optional<Scene> scene = parse_sipp(file, said);
  if (!scene) cannot_read(file, said);
  return picture_of(std::move(*scene), shot);
}

const char* form_of(const Shot& shot) {
  return shot.triangles ? "triangles" : "polygons";
}

/// A computed scene, small, larger, and large; with about the numbers of polygons that farop.md measures
/// with.
struct Sizes {
  std::string_view name;
  std::array<int, 3> sizes;
};
constexpr std::array k_sizes = {
    Sizes{"balls", {1, 2, 3}},  Sizes{"gears", {1, 2, 4}},    Sizes{"mount", {4, 6, 7}},
    Sizes{"rings", {1, 2, 4}},  Sizes{"teapot", {3, 7, 12}},  Sizes{"tetra", {4, 6, 7}},
    Sizes{"tree", {4, 7, 9}},   Sizes{"jacks", {1, 2, 3}},    Sizes{"lattice", {2, 4, 6}},
    Sizes{"shells", {1, 2, 3}}, Sizes{"sombrero", {1, 2, 3}},
};
constexpr std::array k_pixels = {128, 256, 512};

void add_computed(std::vector<SceneSource>& sources, const SpdSceneInfo& scene, Level level) {
  const auto* const found = std::ranges::find(k_sizes, scene.name, &Sizes::name);
  const std::uint64_t classes = level == Level::thorough ? k_pixels.size() : 1;
  for (std::uint64_t i = 0; i < 2 * classes; ++i) {
    // Seen from inside, or of thousands of spheres in each other: less than 0.5% of its samples are to be
    // open.
    const bool deep = scene.name == "lattice" || scene.name == "shells";
    const Shot shot{k_pixels[i / 2], i % 2 == 1, std::int64_t{1} << (deep ? 24 : 16)};
    SpdRequest request;
    request.name = scene.name;
    if (found != k_sizes.end()) request.size = found->sizes[i / 2];
    SceneSource& source = sources.emplace_back();
    source.name = scene.name, source.index = i;
    source.purpose = fmt::format("{}{}: {}, {} x {} pixels, as {}.", scene.name,
                                 request.size ? fmt::format(" of size {}", *request.size) : "",
                                 scene.description, shot.pixels, shot.pixels, form_of(shot));
    source.draw = [request, shot] { return draw_computed(request, shot); };
    // One scene of large polygons and one of many small ones; thoroughly all.
    source.with_relations = i < 2 && (level == Level::thorough || (scene.name == "gears" && i == 0) ||
                                      (scene.name == "teapot" && i == 1));
  }
}

void add_scripts(std::vector<SceneSource>& sources) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(data_file("scenes") / "sipp", error)) {
    if (entry.path().extension() == ".sipp") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    for (std::uint64_t i = 0; i < 2; ++i) {
      const Shot shot{256, i == 1, std::int64_t{1} << 24};
      SceneSource& source = sources.emplace_back();
      source.name = file.stem().string(), source.index = i;
      source.purpose = fmt::format("{}: a scene by script, {} x {} pixels, as {}.", file.filename().string(),
                                   shot.pixels, shot.pixels, form_of(shot));
      source.draw = [path = file.string(), shot] { return draw_script(path, shot); };
    }
  }
}

}  // namespace

std::vector<SceneSource> check_scenes(Level level) {
  std::vector<SceneSource> sources;
  if (level == Level::quick) return sources;
  for (const SpdSceneInfo& scene : spd_scenes()) add_computed(sources, scene, level);
  if (level == Level::thorough) add_scripts(sources);
  return sources;
}

}  // namespace farop::app
