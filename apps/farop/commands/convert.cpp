// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <numeric>

#include "command_line.h"
#include "core/output_file.h"
#include "export/nff_writer.h"
#include "geometry/triangulate.h"
#include "scene/plane.h"
#include "scene/traverse.h"
#include "session.h"

namespace farop::app {
namespace {

struct ConvertOptions {
  InputOptions input;
  std::string output;
  ViewOptions view;
  SceneOptions scene;
};

void run(Session& session, const ConvertOptions& options) {
  const std::string output = output_path(options.output, options.input.files, ".nff");
  load_inputs(session, options.input);
  const auto view = finish_loading(session, options.view, options.scene, Viewport{}, 1, false);
  if (view) {
    // Written whole: defaults that were filled in become part of the file.
    ViewParameters& parameters = session.scene.view;
    parameters.up = view->camera.up;
    parameters.angle = view->camera.angle_degrees;
    parameters.hither = view->camera.hither;
    parameters.resolution = {view->viewport.resolution.x, view->viewport.resolution.y};
  }
  NffWriteOptions writing;
  writing.name = output == "-" ? "standard output" : output;
  TriangulateScratch scratch;
  std::vector<std::uint32_t> ring;
  if (options.scene.triangles) {
    writing.triangulate = [&](std::span<const V3d> corners, std::vector<CornerTriangle>& triangles) {
      ring.resize(corners.size());
      std::iota(ring.begin(), ring.end(), 0);
      triangulate(corners, plane_normal(corners, ring).value_or(V3d(0, 0, 1)), triangles, scratch);
    };
  }
  session.report.polygons_loaded = totals(session.scene).polygons;
  {
    const TimedSlice slice(session.clocks.write);
    OutputFile file(output);
    write_nff(session.scene, writing, file, session.console);
    session.stop_if_strict_found_errors();
    file.commit();
  }
  session.report.outputs.push_back(output);
  session.console.summary("{}: {} polygons (parse {:.3f} s, load {:.3f} s, write {:.3f} s)", writing.name,
                          *session.report.polygons_loaded, session.clocks.parse.total().elapsed,
                          session.clocks.load.total().elapsed, session.clocks.write.total().elapsed);
}

}  // namespace

void add_convert(CommandLine& line) {
  const auto options = std::make_shared<ConvertOptions>();
  CLI::App& command = line.add_command(
      "convert", "scene(s) -> NFF of polygons",
      {{"farop convert gears.nff -o triangles.nff --triangles", "the same scene, triangles only"},
       {"farop convert gears.nff pot.nff -o both.nff", "two scenes merged; the view of the last one counts"}},
      [options](Session& session) { run(session, *options); });
  add_input_options(command, options->input);
  add_output_option(command, options->output, "NFF file; - is standard output", true);
  add_camera_options(command, options->view);
  add_scene_options(command, options->scene);
  line.add_report_options(command);
}

}  // namespace farop::app
