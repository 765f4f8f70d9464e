// SPDX-License-Identifier: GPL-3.0-or-later
#include "spd/spd.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "core/diagnostics.h"
#include "core/error.h"
#include "spd/scenes.h"

namespace farop {
namespace {

using u64 = std::uint64_t;

constexpr u64 power(u64 base, u64 exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

struct Generator {
  SpdSceneInfo info;
  void (*print)(NffPrinter&, const SceneForm&);
  /// Counts of the form that keeps spheres and cones; n = size, r = resolution.
  SpdCounts (*counts)(u64 n, u64 r);
  std::optional<int> own_resolution{};  ///< overrides the user's
};

const Generator k_generators[] = {
    {{"balls", "sphereflake: spheres on spheres, over a floor", 4, 12},
     print_balls,
     [](u64 n, u64) {
       return SpdCounts{.polygons = 1, .spheres = (power(9, n + 1) - 1) / 8, .fills = 2, .lights = 3};
     }},
    {{"gears", "meshed gears with concave faces of 144 corners", 4, 1000},
     print_gears,
     [](u64 n, u64) {
       return SpdCounts{.polygons = 146 * n * n * n + 1, .fills = n * n * n + 1, .lights = 5};
     }},
    {{"mount", "fractal mountain and four glass spheres", 6, 19},
     print_mount,
     [](u64 n, u64) {
       return SpdCounts{.polygons = 2 * power(4, n), .spheres = 4, .fills = 2, .lights = 1};
     }},
    {{"rings", "pyramid of ring clusters in front of a wall", 7, 3000},
     print_rings,
     [](u64 n, u64) {
       const u64 rings = n * (n + 1) * (2 * n + 1);
       return SpdCounts{
           .polygons = 1, .spheres = 5 * rings, .cones = 5 * rings, .fills = rings + 1, .lights = 3};
     }},
    {{"teapot", "Newell's teapot on a checkerboard", 6, 100000},
     print_teapot,
     [](u64 n, u64) {
       return SpdCounts{.polygons = n * n, .patches = 64 * n * n - 8 * n, .fills = 3, .lights = 2};
     }},
    {{"tetra", "recursive tetrahedron", 6, 19},
     print_tetra,
     [](u64 n, u64) { return SpdCounts{.polygons = power(4, n), .fills = 1, .lights = 1}; }},
    {{"tree", "branching cones and spheres", 11, 37},
     print_tree,
     [](u64 n, u64) {
       const u64 branches = power(2, n + 1) - 1;
       return SpdCounts{.polygons = 1, .spheres = branches, .cones = branches, .fills = 2, .lights = 7};
     }},
    {{"jacks", "jacks within jacks", 1, 13},
     print_jacks,
     [](u64 n, u64) {
       const u64 jacks = (power(8, n) - 1) / 7;
       return SpdCounts{.spheres = 6 * jacks, .cones = 3 * jacks, .fills = 1, .lights = 1};
     },
     2},
    {{"lattice", "spheres and rods of a cubic lattice, seen from inside", 12, 6000},
     print_lattice,
     [](u64 n, u64) {
       const u64 spheres = power(n + 1, 3), rods = 3 * n * (n + 1) * (n + 1);
       return SpdCounts{.spheres = spheres, .cones = rods, .fills = spheres + rods, .lights = 6};
     }},
    {{"shells", "sea shell: spheres that grow along a spiral", 5, 32},
     print_shells,
     [](u64 n, u64) { return SpdCounts{.spheres = 180 * power(2, n) + 1, .fills = 1, .lights = 1}; }},
    {{"sombrero", "height field of a damped cosine", 1, 15},
     print_sombrero,
     [](u64 n, u64) {
       const u64 cells = 32 * power(2, n - 1) - 1;
       return SpdCounts{.polygons = 2 * cells * cells, .fills = 1, .lights = 1};
     }},
    {{"nurbtst", "one bicubic B-spline patch", 1, 1, true},
     print_nurbtst,
     [](u64, u64) { return SpdCounts{.patches = 1500, .fills = 1, .lights = 1}; }},
    {{"sample", "three tori, a cone and a disc", 1, 1, true},
     print_sample,
     [](u64, u64 r) {
       return SpdCounts{.polygons = 16, .patches = 96 * r * r, .cones = 1, .fills = 5, .lights = 1};
     }},
    {{"hollow-cube", "closed solid: a cube with a square hole, 128 triangles", 1, 1, true},
     print_hollow_cube,
     [](u64, u64) { return SpdCounts{.polygons = 128, .fills = 1, .lights = 1}; }},
    {{"solid-torus", "closed solid: a torus of 624 quadrilaterals", 1, 1, true},
     print_solid_torus,
     [](u64, u64) { return SpdCounts{.polygons = 624, .fills = 1, .lights = 1}; }},
    {{"solid-cylinder", "closed solid: a cylinder of 1826 quadrilaterals and 166 triangles", 1, 1, true},
     print_solid_cylinder,
     [](u64, u64) { return SpdCounts{.polygons = 1992, .fills = 1, .lights = 1}; }},
};

const Generator& find_generator(std::string_view name) {
  const auto named = [name](const Generator& generator) { return generator.info.name == name; };
  if (const auto found = std::ranges::find_if(k_generators, named); found != std::end(k_generators))
    return *found;
  std::vector<std::string_view> names;
  for (const Generator& generator : k_generators) names.push_back(generator.info.name);
  throw Error(ExitStatus::usage, fmt::format("unknown scene '{}'", printable(name)),
              fmt::format("scenes: {}", fmt::join(names, ", ")));
}

SceneForm checked_form(const SpdRequest& request, const Generator& generator) {
  const SpdSceneInfo& info = generator.info;
  SceneForm form;
  form.size = request.size.value_or(info.default_size);
  form.tessellate = request.tessellate;
  form.resolution = request.resolution.value_or(k_spd_default_resolution);
  if (form.size < 1)
    throw Error(ExitStatus::usage,
                fmt::format("size {} of scene '{}': sizes begin at 1", form.size, info.name),
                fmt::format("the default is {}", info.default_size));
  if (form.size > info.max_size && !info.size_ignored)
    throw Error(ExitStatus::usage, fmt::format("size {} of scene '{}' is too large", form.size, info.name),
                fmt::format("up to {} is possible; the default is {}", info.max_size, info.default_size));
  if (form.resolution < 1 || form.resolution > k_max_detail)
    throw Error(ExitStatus::usage, fmt::format("tessellation resolution {} is out of range", form.resolution),
                fmt::format("1 to {}; the default is {}", k_max_detail, k_spd_default_resolution));
  if (generator.own_resolution) form.resolution = *generator.own_resolution;
  return form;
}

SpdCounts counts_of(const Generator& generator, const SceneForm& form) {
  const auto r = static_cast<u64>(form.resolution);
  SpdCounts counts = generator.counts(static_cast<u64>(form.size), r);
  if (form.tessellate) {
    counts.patches += 12 * r * r * counts.spheres + 8 * r * counts.cones;
    counts.spheres = counts.cones = 0;
  }
  return counts;
}

}  // namespace

std::span<const SpdSceneInfo> spd_scenes() {
  static const std::vector<SpdSceneInfo> infos = [] {
    std::vector<SpdSceneInfo> all;
    for (const Generator& generator : k_generators) all.push_back(generator.info);
    return all;
  }();
  return infos;
}

SpdCounts spd_counts(const SpdRequest& request) {
  const Generator& generator = find_generator(request.name);
  return counts_of(generator, checked_form(request, generator));
}

void write_spd(const SpdRequest& request, const TextFunction& out, const ProgressFunction& progress) {
  const Generator& generator = find_generator(request.name);
  const SceneForm form = checked_form(request, generator);
  const SpdCounts counts = counts_of(generator, form);
  NffPrinter printer(form, counts.polygons + counts.patches + counts.spheres + counts.cones, out, progress);
  generator.print(printer, form);
  printer.finish();
}

}  // namespace farop
