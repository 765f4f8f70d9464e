// SPDX-License-Identifier: GPL-3.0-or-later
#include "streaming.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/error.h"
#include "core/word_reader.h"
#include "scene_notes.h"

namespace farop::app {
namespace {

namespace fs = std::filesystem;

/// Triangles that the spheres and cones of a part may become: 32 MB.
constexpr std::size_t k_part_triangles = 16 * 12 * 64 * 64;

/// One frame out of several: the whole of it has begun before and ends later.
class PartSink : public ScreenPolygonSink {
 public:
  explicit PartSink(ScreenPolygonSink& sink) : sink_(sink) {}
  PolygonWants wants() const override { return sink_.wants(); }
  void begin_frame(const ScreenFrame&) override {}
  void polygons(const ScreenPolygonBatch& batch) override { sink_.polygons(batch); }
  void end_frame() override {}

 private:
  ScreenPolygonSink& sink_;
};

Scene scene_of(std::vector<std::shared_ptr<Surface>> surfaces) {
  Scene part;
  part.root.children.push_back(std::make_shared<Object>());
  part.root.children.back()->surfaces = std::move(surfaces);
  return part;
}

/// Whether a scene has the same depths and the same triangles in both.
bool look_alike(const LoadedView& a, const LoadedView& b) {
  return a.camera.from == b.camera.from && world_to_eye(a.camera) == world_to_eye(b.camera) &&
         view_tangents(a.camera, a.viewport).y == view_tangents(b.camera, b.viewport).y &&
         a.viewport.resolution.y == b.viewport.resolution.y;
}

bool same_counts(const InputSummary& a, const InputSummary& b) {
  return a.bytes == b.bytes && a.surfaces == b.surfaces && a.polygons == b.polygons &&
         a.patches == b.patches && a.spheres == b.spheres && a.cones == b.cones && a.lights == b.lights;
}

}  // namespace

std::string obstacle_to_streaming(const InputOptions& input, const SceneOptions& scene) {
  if (scene.normals == "shared") return "--normals shared needs whole surfaces";
  for (const std::string& file : input.files) {
    std::error_code ec;
    if (file == "-") return "standard input can be read only once";
    if (is_script(file, input))
      return fmt::format("{}: a script makes its scene in memory", printable(file, 200));
    if (fs::exists(file, ec) && !fs::is_directory(file, ec) && !fs::is_regular_file(file, ec))
      return fmt::format("{}: no regular file, it can be read only once", printable(file, 200));
  }
  return {};
}

bool should_stream(const std::string& mode, const InputOptions& input, const SceneOptions& scene) {
  if (mode == "off") return false;
  const std::string obstacle = obstacle_to_streaming(input, scene);
  if (mode == "on") {
    if (!obstacle.empty())
      throw Error(ExitStatus::usage, "--stream on: " + obstacle,
                  "leave the option out: the scene goes to memory");
    return true;
  }
  std::uint64_t bytes = 0;
  for (const std::string& file : input.files) {
    std::error_code ec;
    const std::uint64_t size = fs::file_size(file, ec);
    if (!ec) bytes += size;
  }
  return obstacle.empty() && bytes > k_stream_from_bytes;
}

StreamedDrawing::StreamedDrawing(Session& session, const InputOptions& input, const ViewOptions& view,
                                 const SceneOptions& scene, const Viewport& defaults)
    : session_(session), input_(input), view_options_(view), scene_options_(scene), defaults_(defaults) {
  session_.report.streamed.emplace();
  session_.report.streamed->readings = 1;
  farthest_ = -std::numeric_limits<double>::infinity();
  load_inputs(session_, input_,
              nff_options([this](const Scene& so_far, std::vector<std::shared_ptr<Surface>> surfaces) {
                for (const auto& surface : surfaces) log_surface(session_.console, *surface);
                if (!measured_) return;
                const std::optional<LoadedView> view_now = guess_view(so_far.view);
                measured_ = view_now && (!measured_with_ || look_alike(*view_now, *measured_with_));
                if (!measured_) return;
                measured_with_ = view_now;
                measure(scene_of(std::move(surfaces)), *view_now);
              }));
}

// What the view will be if nothing follows that changes it.
std::optional<LoadedView> StreamedDrawing::guess_view(const ViewParameters& so_far) const {
  ViewParameters view = session_.scene.view;
  override_view(view, so_far);
  apply_options(view, view_options_);
  if (!view.from || !view.at || *view.from == *view.at) return std::nullopt;
  DiagnosticList unheard;
  return complete_view(view, view_options_, defaults_, unheard);
}

Detail StreamedDrawing::detail_for(const LoadedView& view) const {
  return {detail_resolution(scene_options_), detail_view(view, 1)};
}

NffOptions StreamedDrawing::nff_options(const NffPartFunction& on_part) const {
  NffOptions options;
  options.on_part = on_part;
  options.part_bytes = input_.part_bytes;
  const auto r = static_cast<std::size_t>(std::max(detail_resolution(scene_options_).value_or(64), 1));
  options.part_curved = std::clamp<std::size_t>(k_part_triangles / (12 * r * r), 1, options.part_curved);
  return options;
}

void StreamedDrawing::measure(Scene part, const LoadedView& view) {
  StreamedScene& sums = *session_.report.streamed;
  tessellate_scene(part, detail_for(view));
  farthest_ = std::max(farthest_, vertex_depths(part, view.camera).farthest);
  const SceneTotals some = totals(part);
  sums.totals.vertices += some.vertices;
  sums.totals.polygons += some.polygons;
  sums.totals.memory_bytes = std::max(sums.totals.memory_bytes, some.memory_bytes);
  sums.spheres_skipped += part.spheres_skipped, sums.cones_skipped += part.cones_skipped;
  if (const std::optional<Bounds> box = world_bounds(part)) {
    if (!sums.bounds) sums.bounds = box;
    for (int axis = 0; axis < 3; ++axis) {
      sums.bounds->low[axis] = std::min(sums.bounds->low[axis], box->low[axis]);
      sums.bounds->high[axis] = std::max(sums.bounds->high[axis], box->high[axis]);
    }
  }
}

void StreamedDrawing::measure_again(const LoadedView& view) {
  const int readings = session_.report.streamed->readings;
  session_.report.streamed.emplace();
  session_.report.streamed->readings = readings;
  farthest_ = -std::numeric_limits<double>::infinity();
  read_again(
      [&](const Scene&, std::vector<std::shared_ptr<Surface>> surfaces) {
        measure(scene_of(std::move(surfaces)), view);
      },
      "measuring");
}

// The messages are known from the first time.
void StreamedDrawing::read_again(const NffPartFunction& on_part, const std::string& what) {
  ++session_.report.streamed->readings;
  const TimedSlice slice(session_.clocks.parse);
  NffOptions options = nff_options(on_part);
  options.threads = input_.threads;
  options.progress = session_.console.progress(what);
  for (reading_ = 0; reading_ < input_.files.size(); ++reading_) {
    const std::string& file = input_.files[reading_];
    DiagnosticList unheard;
    WordReader reader(file);
    const std::optional<Scene> scene = parse_nff(reader, unheard, options);
    if (!scene || !same_counts(scene->inputs.front(), session_.scene.inputs.at(reading_))) {
      throw Error(ExitStatus::input, fmt::format("{}: changed while it was read", printable(file, 200)),
                  "try again, or read it at once with --stream off");
    }
  }
  session_.console.end_progress();
}

LoadedView StreamedDrawing::finish_loading() {
  LoadedView view = *app::finish_loading(session_, view_options_, scene_options_, defaults_, 1, true);
  if (!measured_ || (measured_with_ && !look_alike(view, *measured_with_))) measure_again(view);
  StreamedScene& sums = *session_.report.streamed;
  sums.totals.objects = session_.scene.inputs.size();
  for (const InputSummary& input : session_.scene.inputs) sums.totals.surfaces += input.surfaces;
  session_.scene.spheres_skipped = sums.spheres_skipped;
  session_.scene.cones_skipped = sums.cones_skipped;
  if (!view.camera.yon) view.camera.yon = auto_yon(farthest_, view.camera.near_distance());
  return view;
}

void StreamedDrawing::draw(const GeometryOptions& options, ScreenPolygonSink& sink) {
  const GeometrySetup& setup = *session_.report.setup;
  GeometryClocks& clocks = session_.clocks.drawing;
  begin_drawing(session_, options, sink, session_.report.streamed->totals);
  GeometryReport report;
  {
    const TimedSlice slice(clocks.sink);
    sink.begin_frame(setup.viewport.frame());
  }
  PartSink part_sink(sink);
  const LoadedView view{setup.camera, setup.viewport};
  report.degenerate_of_input.resize(input_.files.size());
  const NffPartFunction draw_part = [&](const Scene&, std::vector<std::shared_ptr<Surface>> surfaces) {
    session_.clocks.parse.stop();
    Scene part = scene_of(std::move(surfaces));
    {
      const TimedSlice slice(session_.clocks.load);
      tessellate_scene(part, detail_for(view));
    }
    const GeometryReport drawn = run_geometry(part, setup, options, part_sink, clocks);
    report.counts += drawn.counts;
    report.degenerate_of_input[reading_] += drawn.degenerate_of_input.front();
    session_.clocks.parse.start();
  };
  read_again(draw_part, "drawing");
  {
    const TimedSlice slice(clocks.sink);
    sink.end_frame();
  }
  session_.report.geometry = report;
  end_drawing(session_);
  session_.console.notice(fmt::format("streamed: the input was read {} times, a part of the scene at a time",
                                      session_.report.streamed->readings));
}

}  // namespace farop::app
