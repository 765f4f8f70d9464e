// SPDX-License-Identifier: GPL-3.0-or-later
#include "session.h"

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/word_reader.h"
#include "parse_nff/parse_nff.h"
#include "parse_sipp/parse_sipp.h"
#include "scene/merge.h"
#include "scene/plane.h"
#include "scene/traverse.h"
#include "scene_notes.h"
#include "shading/noise.h"
#include "shadow/shadow_map.h"
#include "stats.h"

namespace farop::app {
namespace {

namespace fs = std::filesystem;

std::string lower_suffix(const std::string& file) {
  std::string suffix = fs::path(file).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

void check_format(const std::string& file, const InputOptions& options) {
  const std::string suffix = lower_suffix(file);
  if (!options.format.empty() || file == "-" || suffix == ".nff" || is_script(file, options)) return;
  std::error_code ec;
  if (!fs::exists(file, ec) || fs::is_directory(file, ec)) return;  // the reader says what is wrong with it
  throw Error(ExitStatus::usage,
              fmt::format("{}: the suffix does not tell the format, expected .nff, .sipp or .tcl",
                          printable(file, 200)),
              "say --format nff or --format sipp if that is what it is");
}

void log_time(Console& console, const StageTime& t) {
  console.log("Timer stopped (Elapsed: {:.3f}s, User: {:.3f}s, System: {:.3f}s)", t.elapsed, t.user,
              t.system);
}

void log_import(Console& console, const Scene& scene) {
  log_scene(console, scene);
  const InputSummary& in = scene.inputs.front();
  console.log("Imported {} surfaces with {} polygons, {} spheres and {} cones.", in.surfaces,
              in.polygons + in.patches, in.spheres, in.cones);
}

Scene load_nff(Session& session, const std::string& file, NffOptions options) {
  WordReader reader(file);
  options.progress = session.console.progress("parsing");
  session.console.log("NFF scene '{}' will be imported!", reader.name());
  session.console.log("Parsing NFF file, wait...");
  std::optional<Scene> scene = parse_nff(reader, session.console, options);
  session.console.end_progress();
  if (!scene) throw Error(ExitStatus::input, "");
  log_import(session.console, *scene);
  session.console.log("NFF parser done");
  return std::move(*scene);
}

SippOptions script_options(Console& console, const InputOptions& input) {
  SippOptions options;
  options.limits = input.limits;
  options.capture = input.capture;
  for (const std::string& define : input.defines) {
    const std::size_t equals = define.find('=');
    const std::string name = define.substr(0, equals);
    if (equals == std::string::npos || !is_variable_name(name)) {
      throw Error(ExitStatus::usage,
                  fmt::format("--define: '{}' found, expected NAME=VALUE", printable(define)),
                  "a name has letters, digits and _, like --define frame=12");
    }
    options.variables.emplace_back(name, define.substr(equals + 1));
  }
  options.log = [&console](const std::string& line) { console.log("script: {}", line); };
  return options;
}

Scene load_script(Session& session, const std::string& file, const SippOptions& options) {
  session.console.log("SIPP scene '{}' will be imported!", file);
  session.console.log("Running SIPP script, wait...");
  std::optional<Scene> scene = parse_sipp(file, session.console, options);
  if (!scene) throw Error(ExitStatus::input, "");
  log_import(session.console, *scene);
  session.console.log("SIPP script done");
  return std::move(*scene);
}

void average_all_normals(Object& object) {
  for (const auto& surface : object.surfaces) {
    if (surface->averaged_normals.empty()) average_normals(*surface);
  }
  for (const auto& child : object.children) average_all_normals(*child);
}

/// SIPP takes the numbers of shadows and of noise from one sequence, shadows first.
void add_shadows(const Scene& scene, GeometrySetup& setup) {
  Rand48 random;
  const auto next = [&random] { return random.next(); };
  if (cast_shadows(scene, setup, next) > 0) setup.shading.noise = std::make_shared<const NoiseTable>(next);
}

std::string plural(std::uint64_t n, std::string_view noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

}  // namespace

bool is_script(const std::string& file, const InputOptions& options) {
  const std::string suffix = lower_suffix(file);
  if (suffix == ".sipp" || suffix == ".tcl") return true;
  return suffix != ".nff" && options.format == "sipp";
}

void override_view(ViewParameters& view, const ViewParameters& next) {
  const auto take = [](auto& old, const auto& given) {
    if (given) old = given;
  };
  take(view.from, next.from);
  take(view.at, next.at);
  take(view.up, next.up);
  take(view.angle, next.angle);
  take(view.fit, next.fit);
  take(view.hither, next.hither);
  take(view.yon, next.yon);
  take(view.resolution, next.resolution);
  take(view.background, next.background);
}

void apply_options(ViewParameters& view, const ViewOptions& options) {
  override_view(view, view_parameters(options));
  if (yon_is_forced_auto(options)) view.yon.reset();
}

LoadedView complete_view(const ViewParameters& parameters, const ViewOptions& options,
                         const Viewport& defaults, DiagnosticSink& sink) {
  LoadedView view{complete_camera(parameters, sink), defaults};
  Viewport& viewport = view.viewport;
  const ViewParameters::Size size = complete_resolution(parameters, sink);
  viewport.resolution.x = size.x;
  viewport.resolution.y = size.y;
  if (!options.resolution.empty()) {
    const RequestedResolution r = parse_resolution(options.resolution);
    viewport.resolution.z = r.z.value_or(defaults.resolution.z);
    viewport.resolution.color = r.color.value_or(defaults.resolution.color);
  }
  viewport.subpixel_bits = options.subpixel_bits.value_or(defaults.subpixel_bits);
  const bool internal = defaults.pixel_fit == PixelFit::edges;
  const bool edges =
      options.pixel_fit == "edges" || (options.pixel_fit == "auto" && internal && viewport.subpixel_bits > 0);
  viewport.pixel_fit = edges ? PixelFit::edges : PixelFit::centres;
  viewport.half_pixel_border = internal && edges && viewport.subpixel_bits > 0;
  viewport.y_down = options.y_down && !internal;
  return view;
}

DetailView detail_view(const LoadedView& view, int samples) {
  const ViewTangents tangents = view_tangents(view.camera, view.viewport);
  return {view.camera.from, tangents.y, view.viewport.resolution.y * samples};
}

void Session::stop_if_strict_found_errors() const {
  if (console.errors() > 0) throw Error(ExitStatus::input, "");
}

void RunClocks::trace_to(TraceLog& log) {
  total.trace_to(&log, "total");
  parse.trace_to(&log, "parse");
  load.trace_to(&log, "load");
  drawing.geometry.trace_to(&log, "geometry");
  drawing.sink.trace_to(&log, "rasterize");
  write.trace_to(&log, "write");
}

void Session::finish(ExitStatus status) {
  console.end_progress();
  if (!options.stats_file.empty()) write_stats(*this, status);
  if (!options.trace_file.empty()) write_trace(*this);
}

void load_inputs(Session& session, const InputOptions& options, NffOptions nff) {
  nff.threads = options.threads;
  session.console.set_strict(options.strict);
  if (std::count(options.files.begin(), options.files.end(), "-") > 1) {
    throw Error(ExitStatus::usage, "standard input (-) is given twice", "it can be read only once");
  }
  const SippOptions scripts = script_options(session.console, options);
  for (const std::string& file : options.files) {
    check_format(file, options);
    std::optional<Scene> next;
    {
      const TimedSlice slice(session.clocks.parse);
      next = is_script(file, options) ? load_script(session, file, scripts) : load_nff(session, file, nff);
    }
    const TimedSlice slice(session.clocks.load);
    merge_into(session.scene, std::move(*next), session.console);
    session.report.inputs = session.scene.inputs;
  }
  session.stop_if_strict_found_errors();
}

std::optional<LoadedView> finish_loading(Session& session, const ViewOptions& options,
                                         const SceneOptions& scene_options, const Viewport& defaults,
                                         int samples, bool needs_camera) {
  const TimedSlice slice(session.clocks.load);
  Scene& scene = session.scene;
  apply_options(scene.view, options);
  std::optional<LoadedView> view;
  Detail detail{detail_resolution(scene_options), std::nullopt};
  if (needs_camera || (scene.view.from && scene.view.at && *scene.view.from != *scene.view.at)) {
    view = complete_view(scene.view, options, defaults, session.console);
    detail.view = detail_view(*view, samples);
  }
  tessellate_scene(scene, detail);
  if (scene_options.normals == "shared") {
    for (const auto& object : scene.root.children) average_all_normals(*object);
  }
  session.report.has_scene = true;
  session.stop_if_strict_found_errors();
  return view;
}

GeometryOptions geometry_options(Session& session, const SceneOptions& options, bool flat) {
  GeometryOptions geometry;
  geometry.two_sided = options.two_sided.value_or(session.scene.drawing.two_sided.value_or(false));
  geometry.triangles = options.triangles;
  geometry.flat = flat;
  geometry.light_intensity = light_intensity(options, session.scene.lights.size());
  geometry.light_at_eye = !any_sipp(session.scene);
  if (session.scene.lights.empty()) {
    session.console.notice(geometry.light_at_eye
                               ? "the scene has no light: a white one at the eye is used"
                               : "the scene has no light: the ambient term alone is left, as SIPP has it");
  }
  return geometry;
}

void prepare_drawing(Session& session, const LoadedView& view, const GeometryOptions& options, int samples) {
  const TimedSlice slice(session.clocks.drawing.geometry);
  Viewport sampled = view.viewport;
  sampled.resolution.x *= samples;
  sampled.resolution.y *= samples;
  session.report.setup = prepare_geometry(session.scene, view.camera, sampled, options);
  if (!options.unlit) add_shadows(session.scene, *session.report.setup);
  session.report.picture = view.viewport.resolution;
}

void begin_drawing(Session& session, const GeometryOptions& options, const ScreenPolygonSink& sink,
                   const SceneTotals& sums) {
  Console& console = session.console;
  const GeometrySetup& setup = *session.report.setup;
  const Resolution& r = session.report.picture;
  console.log("Hither:{:.2f}, Yon:{:.2f}, Resolution(X,Y,Z,Color):{},{},{},{}", setup.hither, setup.yon, r.x,
              r.y, r.z, r.color);
  console.log("Objects loaded: {}\nSurfaces loaded: {}\nPolygons loaded: {}", sums.objects, sums.surfaces,
              sums.polygons);
  const bool per_pixel = sink.wants().textures;
  if (!per_pixel && !options.unlit) note_lost_patterns(console, session.scene);
  console.log("Creating render data, wait...\nTimer started");
}

void end_drawing(Session& session) {
  Console& console = session.console;
  const Scene& scene = session.scene;
  log_time(console, session.clocks.drawing.geometry.total());
  const GeometryReport& done = *session.report.geometry;
  for (std::size_t i = 0; i < done.degenerate_of_input.size() && i < scene.inputs.size(); ++i) {
    if (done.degenerate_of_input[i] == 0) continue;
    Diagnostic d;
    d.severity = Severity::warning;
    d.where.file = scene.inputs[i].file;
    d.message = fmt::format("{} without area, left out", plural(done.degenerate_of_input[i], "polygon"));
    console.report(std::move(d));
  }
  session.stop_if_strict_found_errors();
}

void draw(Session& session, const GeometryOptions& options, ScreenPolygonSink& sink) {
  begin_drawing(session, options, sink, totals(session.scene));
  session.report.geometry = run_geometry(session.scene, *session.report.setup, options, sink,
                                         session.clocks.drawing, session.console.progress("drawing"));
  session.console.end_progress();
  end_drawing(session);
}

std::string output_path(const std::string& output, const std::vector<std::string>& inputs,
                        const std::string& suffix) {
  std::string path = output;
  if (path.empty()) {
    if (inputs.front() == "-") {
      throw Error(ExitStatus::usage, "standard input has no name to derive the output's from",
                  "say where to write: -o OUT");
    }
    path = fs::path(inputs.front()).filename().replace_extension(suffix).string();
  }
  for (const std::string& input : inputs) {
    std::error_code ec;
    if (input == "-" || path == "-" || !fs::is_regular_file(path, ec)) continue;
    if (fs::equivalent(input, path, ec)) {
      throw Error(ExitStatus::usage, fmt::format("{}: the output is one of the inputs", printable(path, 200)),
                  "write to another file with -o");
    }
  }
  return path;
}

void summarize_drawing(Session& session, const std::string& output) {
  Console& console = session.console;
  const PolygonCounts& c = session.report.geometry->counts;
  const RunClocks& t = session.clocks;
  log_time(console, session.report.sink_writes ? t.write.total() : t.drawing.sink.total());
  console.log("Successful end");
  console.log("Polygons backfacing: {}\nPolygons degenerate: {}\nPolygons totally clipped: {}", c.back_facing,
              c.degenerate, c.totally_clipped);
  console.log("Polygons splited to triangles: {}\nPolygons rendered: {}", c.split_to_triangles, c.rendered);
  std::string triangles =
      session.report.geometry->counts.triangles > 0 ? fmt::format(", as {} triangles", c.triangles) : "";
  console.summary(
      "{} loaded: {} back-facing, {} totally clipped, {} degenerate, {} rendered ({} clipped in part{})",
      plural(c.loaded, "polygon"), c.back_facing, c.totally_clipped, c.degenerate, c.rendered,
      c.partly_clipped, triangles);
  const char* sink_name = session.report.sink_writes ? "write" : "rasterize";
  const double sink_seconds = t.drawing.sink.total().elapsed;
  console.summary("parse {:.3f} s, load {:.3f} s, geometry {:.3f} s, {} {:.3f} s{}", t.parse.total().elapsed,
                  t.load.total().elapsed, t.drawing.geometry.total().elapsed, sink_name, sink_seconds,
                  t.write.ran() ? fmt::format(", write {:.3f} s", t.write.total().elapsed) : "");
  if (!output.empty()) {
    const Resolution& r = session.report.picture;
    console.summary("{}: {} x {}", output == "-" ? "standard output" : output, r.x, r.y);
  }
}

}  // namespace farop::app
