// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "command_line.h"
#include "core/word_reader.h"
#include "export/flat_reader.h"
#include "picture_library.h"
#include "raster/internal_rasterizer.h"
#include "session.h"

namespace farop::app {
namespace {

struct RasterOptions {
  InputOptions input;
  std::string output, depth_file;
  std::vector<double> background;
  bool y_down = false;
  std::string mode = "gouraud";
};

void run(Session& session, const RasterOptions& options) {
  if (options.input.files.size() != 1) {
    throw Error(ExitStatus::usage,
                fmt::format("{} inputs given, expected one flat file", options.input.files.size()));
  }
  const std::string output = output_path(options.output, options.input.files, ".ppm");
  check_picture_path(output);
  if (!options.depth_file.empty()) picture_library().check_depth_path(options.depth_file);

  InternalRasterizerOptions drawing;
  drawing.mode = draw_mode(options.mode);
  drawing.keep_depth = !options.depth_file.empty();
  if (!options.background.empty())
    drawing.background = {options.background[0], options.background[1], options.background[2]};
  InternalRasterizer rasterizer(drawing);
  WordReader reader(options.input.files.front());
  FlatReadOptions reading;
  reading.y_down = options.y_down;
  reading.progress = session.console.progress("drawing");
  bool whole = false;
  {
    const TimedSlice slice(session.clocks.drawing.sink);  // reading and drawing alternate polygon by polygon
    whole = read_flat(reader, session.console, rasterizer, reading);
  }
  session.console.end_progress();
  if (!whole) throw Error(ExitStatus::input, "");
  const Framebuffer picture = rasterizer.take();
  session.report.polygons_loaded = rasterizer.counts().polygons;
  session.report.raster = {"internal", options.mode, 1};
  {
    const TimedSlice slice(session.clocks.write);
    write_picture_file(output, picture);
    if (!options.depth_file.empty()) picture_library().write_depth(options.depth_file, picture);
  }
  session.report.outputs.push_back(output);
  if (!options.depth_file.empty()) session.report.outputs.push_back(options.depth_file);
  session.console.summary("{}: {} polygons, {} x {} ({:.3f} s)", output == "-" ? "standard output" : output,
                          *session.report.polygons_loaded, picture.width, picture.height,
                          session.clocks.drawing.sink.total().elapsed);
}

}  // namespace

void add_raster(CommandLine& line) {
  const auto options = std::make_shared<RasterOptions>();
  CLI::App& command = line.add_command(
      "raster", "flat file -> picture",
      {{"farop raster gears.scr -o gears.png", "look at a flat file"},
       {"farop raster gears.scr -o gears.ppm --background 1 1 1 --mode line", "its edges on white"}},
      [options](Session& session) { run(session, *options); });
  command.add_option("input", options->input.files, "flat file; - is standard input")
      ->required()
      ->type_name("IN.scr")
      ->group("Input");
  command.add_flag("--y-down", options->y_down, "the file counts rows from the top")->group("Input");
  add_output_option(command, options->output,
                    "picture: ppm, png, exr, tif ...; - is standard output [IN.ppm]");
  command.add_option("--depth", options->depth_file, "write depths too, .exr or .tif")
      ->type_name("FILE")
      ->group("Output");
  add_background_option(command, options->background, "Drawing");
  command.add_option("--mode", options->mode, "shading [gouraud]")
      ->check(CLI::IsMember({"line", "flat", "gouraud"}))
      ->type_name("line|flat|gouraud")
      ->group("Drawing");
  line.add_report_options(command);
}

}  // namespace farop::app
