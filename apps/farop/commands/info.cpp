// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "command_line.h"
#include "core/output_file.h"
#include "scene/bounds.h"
#include "scene/traverse.h"
#include "scene_notes.h"
#include "session.h"

namespace farop::app {
namespace {

struct InfoOptions {
  InputOptions input;
};

std::string text_of(const V3d& v) {
  return fmt::format("{:g} {:g} {:g}", v.x, v.y, v.z);
}
std::string text_of(const Rgb& c) {
  return fmt::format("{:g} {:g} {:g}", c.r, c.g, c.b);
}

std::string view_text(const ViewParameters& v) {
  std::string out;
  const auto row = [&](const char* name, const std::string& value) {
    out += fmt::format("  {:<12}{}\n", name, value);
  };
  if (v.from) row("from", text_of(*v.from));
  if (v.at) row("at", text_of(*v.at));
  if (v.up) row("up", text_of(*v.up));
  if (v.angle) row("angle", fmt::format("{:g} degrees", *v.angle));
  if (v.hither) row("hither", fmt::format("{:g}", *v.hither));
  if (v.yon) row("yon", fmt::format("{:g}", *v.yon));
  if (v.resolution) row("resolution", fmt::format("{} x {}", v.resolution->x, v.resolution->y));
  if (v.background) row("background", text_of(*v.background));
  return out.empty() ? "view          none\n" : "view\n" + out;
}

std::string material_text(const Material& m) {
  return fmt::format("color {}  kd {:g}  ks {:g}  shine {:g}  T {:g}", text_of(m.color), m.kd, m.ks, m.shine,
                     m.transmittance);
}

void tree_text(const Object& object, int depth, std::string& out) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  out += fmt::format("{}object '{}'{}\n", indent, printable(object.name, 200),
                     object.to_parent == M44d() ? "" : " (transformed)");
  for (const auto& s : object.surfaces) {
    std::uint64_t spheres = 0;
    for (const CurvedPrimitive& c : s->curved) spheres += c.kind == CurvedPrimitive::Kind::sphere ? 1 : 0;
    out += fmt::format("{}  surface: {} vertices, {} polygons, {} spheres, {} cones  {}\n", indent,
                       s->positions.size(), s->polygons.size(), spheres, s->curved.size() - spheres,
                       s->shader != nullptr ? s->shader->describe() : material_text(s->material));
  }
  for (const auto& child : object.children) tree_text(*child, depth + 1, out);
}

void run(Session& session, const InfoOptions& options) {
  load_inputs(session, options.input);
  const Scene& scene = session.scene;
  session.report.has_scene = true;
  const SceneTotals sums = totals(scene);
  session.report.polygons_loaded = sums.polygons;
  std::string out;
  for (const InputSummary& in : scene.inputs) {
    out += fmt::format(
        "{}: {} bytes, {}; {} surfaces, {} polygons, {} patches, {} spheres, {} cones, {} lights\n",
        printable(in.file, 4096), in.bytes, in.format, in.surfaces, in.polygons, in.patches, in.spheres,
        in.cones, in.lights);
  }
  out += fmt::format(
      "objects       {}\nsurfaces      {}\npolygons      {}\nvertices      {}\ncurved        {}\n",
      sums.objects, sums.surfaces, sums.polygons, sums.vertices, sums.curved);
  out += fmt::format("memory        {:.1f} MB\n", static_cast<double>(sums.memory_bytes) / 1e6);
  if (const auto box = world_bounds(scene)) {
    out += fmt::format("bounds        {} .. {}   (polygons)\n", text_of(box->low), text_of(box->high));
  }
  out += view_text(scene.view);
  for (const Light& light : scene.lights) {
    if (light.kind != LightKind::point || !light.active) {
      out += fmt::format("light         {}\n", light_text(light));
      continue;
    }
    out += fmt::format("light         {}{}\n", text_of(light.position),
                       light.color ? "  color " + text_of(*light.color) : "");
  }
  if (session.console.verbose()) {
    for (const auto& child : scene.root.children) tree_text(*child, 0, out);
  }
  OutputFile file("-");
  file.write(out);
  file.commit();
}

}  // namespace

void add_info(CommandLine& line) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App& command = line.add_command(
      "info", "counts, bounds, view, lights and surfaces of scene(s)",
      {{"farop info gears.nff", "what is in a scene"},
       {"farop info gears.nff pot.nff --verbose", "the whole tree of a merged scene, surface by surface"}},
      [options](Session& session) { run(session, *options); });
  add_input_options(command, options->input);
  line.add_report_options(command);
}

}  // namespace farop::app
