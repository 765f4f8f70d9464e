// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "command_line.h"
#include "core/limits.h"
#include "drawer.h"
#include "picture_library.h"
#include "repeat_file.h"
#include "scene/traverse.h"
#include "scene_notes.h"
#include "session.h"

namespace farop::app {
namespace {

struct RenderOptions {
  InputOptions input;
  std::string output;
  ViewOptions view;
  SceneOptions scene;
  DrawingOptions drawing;
  RasterizerOptions rasterizer;
};

/// The internal rasterizer's default is a good picture: window edges mapped, 8 sub-pixel bits, 24 bits of
/// depth. Others get the numbers of the flat file.
Viewport viewport_defaults(RasterizerKind kind) {
  Viewport viewport;
  if (kind != RasterizerKind::internal) return viewport;
  viewport.resolution.z = std::int64_t{1} << 24;
  viewport.pixel_fit = PixelFit::edges;
  viewport.subpixel_bits = 8;
  return viewport;
}

void write_picture(Session& session, const Framebuffer& picture, const std::string& output,
                   const std::string& depth_file) {
  const TimedSlice slice(session.clocks.write);
  write_picture_file(output, picture);
  session.report.outputs.push_back(output);
  if (depth_file.empty()) return;
  picture_library().write_depth(depth_file, picture);
  session.report.outputs.push_back(depth_file);
}

/// Users' rasterizers get a frame of this size, which the interface limits.
void check_sampled_size(RasterizerKind kind, const Resolution& r, int samples) {
  if (kind == RasterizerKind::internal || std::max(r.x, r.y) * samples <= k_max_resolution) return;
  throw Error(ExitStatus::usage,
              fmt::format("--samples {} of {} x {} pixels: the frame would be larger than {} pixels", samples,
                          r.x, r.y, k_max_resolution),
              "use fewer --samples or a smaller --resolution");
}

/// The scene's own mode and samples, known now, count where no option does.
void choose_mode(Session& session, const DrawingOptions& options, RasterizerKind kind,
                 DrawerOptions& drawing) {
  drawing.mode = drawing_mode(session.console, options.mode, session.scene, kind == RasterizerKind::internal);
  drawing.samples = drawing_samples(options.samples, session.scene);
  if (drawing.mode != DrawMode::line || drawing.samples == 1) return;
  if (options.samples) session.console.notice("--samples is ignored in line mode");
  drawing.samples = 1;
}

void run(Session& session, const RenderOptions& options) {
  const ChosenRasterizer chosen = choose_rasterizer(options.rasterizer);
  const bool null = chosen.kind == RasterizerKind::null;
  DrawerOptions drawing;
  drawing.mode = draw_mode(options.drawing.mode);
  drawing.keep_depth = !options.drawing.depth_file.empty();
  if (null && (!options.output.empty() || drawing.keep_depth)) {
    throw Error(ExitStatus::usage, "the rasterizer 'null' draws nothing, so there is no picture to write",
                "leave out -o and --depth, or use --rasterizer internal");
  }
  check_drawing(chosen, options.rasterizer, drawing);
  const std::string output = null ? "" : output_path(options.output, options.input.files, ".ppm");
  if (drawing.keep_depth) {
    picture_library().check_depth_path(output_path(options.drawing.depth_file, options.input.files, ""));
  }
  if (!null) check_picture_path(output);

  // With a user's rasterizer --threads are its own.
  const int threads = chosen.kind == RasterizerKind::internal ? options.rasterizer.threads : 1;
  InputOptions input = options.input;
  input.threads = threads;
  load_inputs(session, input);
  choose_mode(session, options.drawing, chosen.kind, drawing);
  const LoadedView view = *finish_loading(session, options.view, options.scene,
                                          viewport_defaults(chosen.kind), drawing.samples, true);
  check_sampled_size(chosen.kind, view.viewport.resolution, drawing.samples);
  const bool flat = drawing.mode == DrawMode::flat;
  GeometryOptions geometry = geometry_options(session, options.scene, flat);
  geometry.unlit = drawing.mode == DrawMode::line;
  constexpr std::size_t k_small_scene = 50000;  // polygons; done before another thread has started
  geometry.threads = threads == 0 && totals(session.scene).polygons < k_small_scene ? 1 : threads;
  prepare_drawing(session, view, geometry, drawing.samples);
  if (!null) session.console.log("Image file to be created: '{}'", output);
  const std::string mode = name_of(drawing.mode);
  session.console.log("Render Mode: {}", mode);
  // The geometry stage gives a polygon one colour already.
  if (flat && chosen.kind != RasterizerKind::internal) drawing.mode = DrawMode::gouraud;
  drawing.background = session.scene.view.background.value_or(Rgb{});
  drawing.additive_transparency = all_sipp(session.scene);
  drawing.shading = session.report.setup->shading;
  const std::unique_ptr<Drawer> drawer = make_drawer(session, chosen, options.rasterizer, drawing);
  session.report.raster = {drawer->name(), mode, drawing.samples, {}, {}, {}};
  std::optional<Framebuffer> picture;
  try {
    draw(session, geometry, drawer->sink());
    picture = drawer->take();
  } catch (const PluginFailure& failure) {
    drawer->report(*session.report.raster);
    GeometryOptions again = geometry;
    again.triangles = again.triangles || drawer->sink().wants().triangles;
    explain_failure(session, failure, chosen, [&](ScreenPolygonSink& sink) {
      GeometryClocks clocks;
      run_geometry(session.scene, *session.report.setup, again, sink, clocks);
    });
    throw;
  }
  drawer->report(*session.report.raster);
  if (picture) write_picture(session, *picture, output, options.drawing.depth_file);
  if (!picture && !null)
    session.console.notice("the rasterizer draws elsewhere: there is no picture to write");
  summarize_drawing(session, picture ? output : "");
  end_of_check(*session.report.raster, options.rasterizer);
}

void add_drawing_options(CLI::App& command, DrawingOptions& options) {
  command.add_option("--mode", options.mode, "shading [the scene's, else gouraud]")
      ->check(CLI::IsMember({"line", "flat", "gouraud", "phong"}))
      ->type_name("line|flat|gouraud|phong")
      ->group("Drawing");
  command
      .add_option(
          "--samples", options.samples,
          fmt::format("super-sampling, A x A samples a pixel, 1..{} [the scene's, else 1]", k_max_samples))
      ->check(CLI::Range(1, k_max_samples))
      ->type_name("A")
      ->group("Drawing");
  command.add_option("--depth", options.depth_file, "write depths too, .exr or .tif (integer z as float)")
      ->type_name("FILE")
      ->group("Output");
}

}  // namespace

void add_render(CommandLine& line) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App& command = line.add_command(
      "render", "scene(s) -> picture, by the internal rasterizer or yours",
      {{"farop render gears.nff -o gears.png --samples 4", "an anti-aliased picture of a scene"},
       {"farop render gears.nff -o wire.ppm --mode line --resolution 640x480", "its edges, in another size"}},
      [options](Session& session) { run(session, *options); });
  add_input_options(command, options->input);
  add_output_option(command, options->output,
                    "picture: ppm, png, exr, tif ...; - is standard output [IN.ppm]");
  add_view_options(command, options->view);
  add_scene_options(command, options->scene);
  add_side_option(command, options->scene);
  add_light_option(command, options->scene);
  add_drawing_options(command, options->drawing);
  add_rasterizer_options(command, options->rasterizer);
  line.add_report_options(command);
}

}  // namespace farop::app
