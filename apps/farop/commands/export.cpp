// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "command_line.h"
#include "core/output_file.h"
#include "export/flat_writer.h"
#include "scene_notes.h"
#include "session.h"
#include "streaming.h"

namespace farop::app {
namespace {

struct ExportOptions {
  InputOptions input;
  std::string output;
  ViewOptions view;
  SceneOptions scene;
  std::string mode;  ///< empty: the scene's
  std::string stream = "auto";
};

void run(Session& session, const ExportOptions& options) {
  const std::string output = output_path(options.output, options.input.files, ".scr");
  std::optional<StreamedDrawing> streamed;
  if (should_stream(options.stream, options.input, options.scene)) {
    streamed.emplace(session, options.input, options.view, options.scene, Viewport{});
  } else {
    load_inputs(session, options.input);
  }
  const LoadedView view = streamed
                              ? streamed->finish_loading()
                              : *finish_loading(session, options.view, options.scene, Viewport{}, 1, true);
  const bool flat = drawing_mode(session.console, options.mode, session.scene, false) == DrawMode::flat;
  const GeometryOptions geometry = geometry_options(session, options.scene, flat);
  prepare_drawing(session, view, geometry, 1);
  session.report.sink_writes = true;
  session.console.log("Flat file to be created: '{}'", output);
  OutputFile file(output);
  FlatWriter writer(file);
  streamed ? streamed->draw(geometry, writer) : draw(session, geometry, writer);
  file.commit();
  session.report.outputs.push_back(output);
  summarize_drawing(session, output);
}

}  // namespace

void add_export(CommandLine& line) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App& command =
      line.add_command("export", "scene(s) -> screen-coordinate flat file",
                       {{"farop export gears.nff -o gears.scr --resolution 512 512 512 128",
                         "polygons for a rasterizer that lives elsewhere"},
                        {"farop export gears.nff -o - --triangles", "triangles only, to standard output"}},
                       [options](Session& session) { run(session, *options); });
  add_input_options(command, options->input);
  add_output_option(command, options->output, "flat file; - is standard output [IN.scr]");
  add_view_options(command, options->view);
  add_scene_options(command, options->scene);
  add_side_option(command, options->scene);
  add_light_option(command, options->scene);
  command
      .add_option("--mode", options->mode,
                  "flat: one vertex's colour each polygon [the scene's, else gouraud]")
      ->check(CLI::IsMember({"flat", "gouraud"}))
      ->type_name("flat|gouraud")
      ->group("Drawing");
  command.add_option("--stream", options->stream, "read files again, keep none [auto: from 64 MB on]")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->type_name("auto|on|off")
      ->group("Input");
  line.add_report_options(command);
}

}  // namespace farop::app
