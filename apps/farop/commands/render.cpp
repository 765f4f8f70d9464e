// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "command_line.h"
#include "core/limits.h"
#include "picture_library.h"
#include "raster/internal_rasterizer.h"
#include "session.h"

namespace farop::app {
namespace {

struct RenderOptions {
  InputOptions input;
  std::string output;
  ViewOptions view;
  SceneOptions scene;
  DrawingOptions drawing;
};

/// Draws nothing: the geometry stage alone, for timing.
class NullRasterizer : public ScreenPolygonSink {
 public:
  void begin_frame(const ScreenFrame&) override {}
  void polygons(const ScreenPolygonBatch&) override {}
  void end_frame() override {}
};

/// A good picture: window edges mapped, 8 sub-pixel bits, 24 bits of depth.
Viewport picture_defaults() {
  Viewport viewport;
  viewport.resolution.z = std::int64_t{1} << 24;
  viewport.pixel_fit = PixelFit::edges;
  viewport.subpixel_bits = 8;
  return viewport;
}

void write_picture(Session& session, InternalRasterizer& rasterizer, const std::string& output,
                   const std::string& depth_file) {
  const Framebuffer picture = rasterizer.take();
  const TimedSlice slice(session.clocks.write);
  write_picture_file(output, picture);
  session.report.outputs.push_back(output);
  if (depth_file.empty()) return;
  picture_library().write_depth(depth_file, picture);
  session.report.outputs.push_back(depth_file);
}

void run(Session& session, const RenderOptions& options) {
  const bool null = options.drawing.rasterizer == "null";
  const DrawMode mode = draw_mode(options.drawing.mode);
  if (null && (!options.output.empty() || !options.drawing.depth_file.empty())) {
    throw Error(ExitStatus::usage, "the rasterizer 'null' draws nothing, so there is no picture to write",
                "leave out -o and --depth, or use --rasterizer internal");
  }
  if (null && (mode == DrawMode::line || mode == DrawMode::phong)) {
    throw Error(ExitStatus::usage, "modes line and phong exist in the internal rasterizer only");
  }
  const std::string output = null ? "" : output_path(options.output, options.input.files, ".ppm");
  if (!options.drawing.depth_file.empty()) {
    picture_library().check_depth_path(output_path(options.drawing.depth_file, options.input.files, ""));
  }
  if (!null) check_picture_path(output);
  int samples = options.drawing.samples;
  if (mode == DrawMode::line && samples > 1) {
    session.console.notice("--samples is ignored in line mode");
    samples = 1;
  }

  load_inputs(session, options.input);
  const LoadedView view =
      *finish_loading(session, options.view, options.scene, picture_defaults(), samples, true);
  const GeometryOptions geometry = geometry_options(session, options.scene, mode == DrawMode::flat);
  prepare_drawing(session, view, geometry, samples);
  session.report.raster = {options.drawing.rasterizer, options.drawing.mode, samples};
  if (!null) session.console.log("Image file to be created: '{}'", output);
  session.console.log("Render Mode: {}", options.drawing.mode);
  if (null) {
    NullRasterizer nothing;
    draw(session, geometry, nothing);
  } else {
    InternalRasterizerOptions drawing;
    drawing.mode = mode;
    drawing.samples = samples;
    drawing.background = session.scene.view.background.value_or(Rgb{});
    drawing.keep_depth = !options.drawing.depth_file.empty();
    drawing.lights_eye = session.report.setup->lights_eye;
    InternalRasterizer rasterizer(drawing);
    draw(session, geometry, rasterizer);
    write_picture(session, rasterizer, output, options.drawing.depth_file);
  }
  summarize_drawing(session, output);
}

void add_drawing_options(CLI::App& command, DrawingOptions& options) {
  command.add_option("--mode", options.mode, "shading [gouraud]")
      ->check(CLI::IsMember({"line", "flat", "gouraud", "phong"}))
      ->type_name("line|flat|gouraud|phong")
      ->group("Drawing");
  command
      .add_option("--samples", options.samples,
                  fmt::format("super-sampling, A x A samples a pixel, 1..{} [1]", k_max_samples))
      ->check(CLI::Range(1, k_max_samples))
      ->type_name("A")
      ->group("Drawing");
  command.add_option("--rasterizer", options.rasterizer, "null: geometry stage only, for timing [internal]")
      ->check(CLI::IsMember({"internal", "null"}))
      ->type_name("internal|null")
      ->group("Drawing");
  command.add_option("--depth", options.depth_file, "write depths too, .exr or .tif (integer z as float)")
      ->type_name("FILE")
      ->group("Output");
}

}  // namespace

void add_render(CommandLine& line) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App& command = line.add_command(
      "render", "scene(s) -> picture, by the internal rasterizer",
      {{"farop render gears.nff -o gears.png --samples 4", "an anti-aliased picture of a scene"},
       {"farop render gears.nff -o wire.ppm --mode line --resolution 640x480", "its edges, in another size"}},
      [options](Session& session) { run(session, *options); });
  add_input_options(command, options->input);
  add_output_option(command, options->output,
                    "picture: ppm, png, exr, tif ...; - is standard output [IN.ppm]");
  add_view_options(command, options->view);
  add_scene_options(command, options->scene);
  command.add_flag("--two-sided", options->scene.two_sided, "keep polygons that face away")
      ->group("Geometry");
  add_light_option(command, options->scene);
  add_drawing_options(command, options->drawing);
  line.add_report_options(command);
}

}  // namespace farop::app
