// SPDX-License-Identifier: GPL-3.0-or-later
// What the walls around a rasterizer cost: seconds from begin_frame() to the end of end_frame() with the
// rasterizer in a process of its own and in this one.
//
//   isolation_bench [rounds [rasterizer.so]]
//
// Scene gears 8 at 1024 x 1024, and the fastest rasterizer that ships. Twice: polygons from memory, where a
// second process has nothing to gain, and polygons from the geometry stage, as `farop render` has them. The
// two sides take turns frame by frame, so that a slow moment of the machine hits both; the median of the
// ratios of neighbours counts. The second line has processor time, of both processes where there are two: on
// a machine that others use, too, it says more than the clock. Starting the runner is shown apart.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "geometry/pipeline.h"
#include "isolate/isolated_rasterizer.h"
#include "parse_nff/parse_nff.h"
#include "plugin/plugin_rasterizer.h"
#include "scene/merge.h"
#include "scene/tessellate.h"
#include "spd/spd.h"

namespace farop {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Keeps the polygons of a frame.
class Tape : public ScreenPolygonSink {
 public:
  explicit Tape(PolygonWants wants) : wants_(wants) { wants_.max_vertices = true; }
  PolygonWants wants() const override { return wants_; }
  void begin_frame(const ScreenFrame& frame) override { frame_ = frame; }
  void polygons(const ScreenPolygonBatch& batch) override { batches_.push_back(batch); }
  void end_frame() override {}
  void play(ScreenPolygonSink& sink) const {
    sink.begin_frame(frame_);
    for (const ScreenPolygonBatch& batch : batches_) sink.polygons(batch);
    sink.end_frame();
  }

 private:
  PolygonWants wants_;
  ScreenFrame frame_;
  std::vector<ScreenPolygonBatch> batches_;
};

/// The scene and its camera; polygons come from the geometry stage each time.
class Stage {
 public:
  Stage() : scene_(load()) {
    options_.light_intensity = 0.5;
    Viewport viewport;
    viewport.resolution.x = viewport.resolution.y = 1024;
    DiagnosticList diagnostics;
    setup_ = prepare_geometry(scene_, complete_camera(scene_.view, diagnostics), viewport, options_);
  }
  void play(ScreenPolygonSink& sink) const {
    GeometryClocks clocks;
    run_geometry(scene_, setup_, options_, sink, clocks);
  }

 private:
  static Scene load() {
    SpdRequest request;
    request.name = "gears";
    request.size = 8;
    std::string text;
    write_spd(request, [&](std::string_view block) { text += block; });
    WordReader reader(text, "gears");
    DiagnosticList diagnostics;
    Scene scene = std::move(*parse_nff(reader, diagnostics));
    tessellate_scene(scene, {3, std::nullopt});
    return scene;
  }

  Scene scene_;
  GeometryOptions options_;
  GeometrySetup setup_;
};

double cpu_seconds() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Seconds {
  double elapsed = 0, cpu = 0;
};

/// Rounds of one kind, and a line about them.
struct Series {
  std::vector<double> in_process, isolated, ratios;

  void add(double here, double there) {
    in_process.push_back(here), isolated.push_back(there), ratios.push_back(there / here);
  }
  void print(const char* what) {
    std::sort(ratios.begin(), ratios.end());
    const auto at = [&](std::size_t tenths) { return ratios[(ratios.size() - 1) * tenths / 10]; };
    std::printf("%-24s %10.2f ms %10.2f ms   %.3f   (%.3f .. %.3f)   fastest %.2f, %.2f\n", what,
                1e3 * median(in_process), 1e3 * median(isolated), median(ratios), at(1), at(9),
                1e3 * *std::min_element(in_process.begin(), in_process.end()),
                1e3 * *std::min_element(isolated.begin(), isolated.end()));
  }
};

void compare(const char* what, int rounds, PluginRasterizer& here, IsolatedRasterizer& there,
             const std::function<void(ScreenPolygonSink&)>& play) {
  Series elapsed, cpu;
  const auto timed = [&](ScreenPolygonSink& sink) {
    const double cpu_begun = cpu_seconds() + there.report().cpu;
    const auto begun = Clock::now();
    play(sink);
    const double seconds = seconds_since(begun);
    return Seconds{seconds, cpu_seconds() + there.report().cpu - cpu_begun};
  };
  for (int round = -3; round < rounds; ++round) {
    // Who goes first changes: the first one finds the caches colder.
    const bool swap = round % 2 != 0;
    Seconds first = swap ? timed(there) : timed(here), second = swap ? timed(here) : timed(there);
    if (round < 0) continue;  // memory is touched for the first time
    if (swap) std::swap(first, second);
    elapsed.add(first.elapsed, second.elapsed), cpu.add(first.cpu, second.cpu);
  }
  elapsed.print(what);
  cpu.print("  processor time");
}

void run(int rounds, const std::string& library_path) {
  HostServices services({}, {});
  const PluginLibrary library = open_plugin(library_path, services);
  if (library.failure != LoadFailure::none) throw std::runtime_error(library.message);
  PluginRasterizer here(library, services, {});
  IsolationOptions options;
  options.runner = FAROP_RUNNER;
  options.limits.cpu_seconds = 3600, options.limits.wall_seconds = 36000;
  const auto begun = Clock::now();
  IsolatedRasterizer there(library_path, options, {});
  const double start = seconds_since(begun);

  const Stage stage;
  Tape tape(here.wants());
  stage.play(tape);
  std::printf(
      "gears 8, 1024 x 1024, %s: in-process, isolated, ratio (of neighbours: median, 1st .. 9th decile)\n",
      library.name.c_str());
  compare("polygons from memory", rounds, here, there, [&](ScreenPolygonSink& sink) { tape.play(sink); });
  compare("with the geometry stage", rounds, here, there, [&](ScreenPolygonSink& sink) { stage.play(sink); });
  std::printf("start of the runner: %.1f ms, once\n", 1e3 * start);
}

}  // namespace
}  // namespace farop

int main(int argc, char** argv) {
  try {
    farop::run(argc > 1 ? std::max(std::atoi(argv[1]), 1) : 101, argc > 2 ? argv[2] : FAROP_TRAPEZOID);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "isolation_bench: %s\n", error.what());
    return 1;
  }
}
