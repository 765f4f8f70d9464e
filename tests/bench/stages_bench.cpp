// SPDX-License-Identifier: GPL-3.0-or-later
// Speed of parsing, geometry, flat-file writing and rasterizing on standard scenes, each stage alone.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <string>

#include "core/error.h"
#include "export/flat_reader.h"
#include "export/flat_writer.h"
#include "geometry/pipeline.h"
#include "parse_nff/parse_nff.h"
#include "raster/internal_rasterizer.h"
#include "scene/merge.h"
#include "scene/tessellate.h"
#include "spd/spd.h"

namespace farop {
namespace {

struct SceneName {
  const char* name;
  int size;
};
constexpr SceneName k_scenes[] = {{"gears", 4}, {"gears", 8}, {"mount", 8}, {"balls", 4}, {"tetra", 9}};

/// Text of a scene; balls in its tessellated form, so that there is text to parse and polygons to draw.
const std::string& text_of(const SceneName& scene) {
  static std::map<std::string, std::string> texts;
  std::string& text = texts[scene.name + std::to_string(scene.size)];
  if (text.empty()) {
    SpdRequest request;
    request.name = scene.name;
    request.size = scene.size;
    request.tessellate = std::string(scene.name) == "balls";
    write_spd(request, [&](std::string_view block) { text += block; });
  }
  return text;
}

Scene parse(const std::string& text, int threads = 1) {
  WordReader reader(text, "bench");
  DiagnosticList messages;
  NffOptions options;
  options.threads = threads;
  return parse_nff(reader, messages, options).value();
}

struct Prepared {
  Scene scene;
  GeometryOptions options;
  GeometrySetup setup;
};

enum class For { picture, flat_file };

Prepared prepare(const SceneName& name, bool triangles, For use) {
  Prepared p;
  p.scene = parse(text_of(name));
  tessellate_scene(p.scene, {3, std::nullopt});
  p.options.triangles = triangles;
  DiagnosticList messages;
  Viewport viewport;
  viewport.resolution = {1024, 1024, 65536, 256};
  if (use == For::picture) {
    viewport.resolution.z = std::int64_t{1} << 24;
    viewport.pixel_fit = PixelFit::edges;
    viewport.subpixel_bits = 8;
    viewport.half_pixel_border = true;
  }
  p.setup = prepare_geometry(p.scene, complete_camera(p.scene.view, messages), viewport, p.options);
  return p;
}

/// Keeps all batches, to play them again without the stage before.
class Tape : public ScreenPolygonSink {
 public:
  void begin_frame(const ScreenFrame& f) override { frame = f; }
  void polygons(const ScreenPolygonBatch& batch) override { batches.push_back(batch); }
  void end_frame() override {}
  void play(ScreenPolygonSink& sink) const {
    sink.begin_frame(frame);
    for (const ScreenPolygonBatch& batch : batches) sink.polygons(batch);
    sink.end_frame();
  }
  std::uint64_t count() const {
    std::uint64_t n = 0;
    for (const ScreenPolygonBatch& batch : batches) n += batch.polygons.size();
    return n;
  }

  ScreenFrame frame;
  std::vector<ScreenPolygonBatch> batches;
};

class Nothing : public ScreenPolygonSink {
 public:
  void begin_frame(const ScreenFrame&) override {}
  void polygons(const ScreenPolygonBatch& batch) override { benchmark::DoNotOptimize(batch.vertices.data()); }
  void end_frame() override {}
};

using benchmark::Counter;
constexpr auto k_rate = Counter::kIsIterationInvariantRate;

void parsing(benchmark::State& state, const SceneName& name) {
  const std::string& text = text_of(name);
  for (auto _ : state) benchmark::DoNotOptimize(parse(text));
  state.counters["MB/s"] = Counter(static_cast<double>(text.size()) * 1e-6, k_rate);
}

/// The rate is by the clock on the wall; the column of CPU time is that of both threads.
void parsing_on_two_threads(benchmark::State& state, const SceneName& name) {
  const std::string& text = text_of(name);
  for (auto _ : state) benchmark::DoNotOptimize(parse(text, 2));
  state.counters["MB/s"] = Counter(static_cast<double>(text.size()) * 1e-6, k_rate);
}

void geometry(benchmark::State& state, const SceneName& name) {
  const Prepared p = prepare(name, false, For::picture);
  Nothing nothing;
  std::uint64_t corners = 0, polygons = 0;
  for (auto _ : state) {
    GeometryClocks clocks;
    const PolygonCounts counts = run_geometry(p.scene, p.setup, p.options, nothing, clocks).counts;
    corners = counts.vertices;
    polygons = counts.loaded;
  }
  state.counters["Mvertices/s"] = Counter(static_cast<double>(corners) * 1e-6, k_rate);
  state.counters["Mpolygons/s"] = Counter(static_cast<double>(polygons) * 1e-6, k_rate);
}

void flat_writing(benchmark::State& state, const SceneName& name) {
  const Prepared p = prepare(name, false, For::flat_file);
  Tape tape;
  GeometryClocks clocks;
  run_geometry(p.scene, p.setup, p.options, tape, clocks);
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    OutputFile file("stages_bench.scr");  // never committed: written to a new file and removed
    FlatWriter writer(file);
    tape.play(writer);
    bytes = file.size();
  }
  state.counters["MB/s"] = Counter(static_cast<double>(bytes) * 1e-6, k_rate);
}

void flat_reading(benchmark::State& state, const SceneName& name) {
  const Prepared p = prepare(name, false, For::flat_file);
  const std::string path = "stages_bench_read.scr";
  {
    OutputFile file(path);
    FlatWriter writer(file);
    GeometryClocks clocks;
    run_geometry(p.scene, p.setup, p.options, writer, clocks);
    file.commit();
  }
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    WordReader reader(path);
    DiagnosticList messages;
    Nothing nothing;
    if (!read_flat(reader, messages, nothing)) state.SkipWithError("the file cannot be read");
    bytes = reader.bytes_read();
  }
  std::remove(path.c_str());
  state.counters["MB/s"] = Counter(static_cast<double>(bytes) * 1e-6, k_rate);
}

/// Of a frame, by the path that counts them.
std::uint64_t fragments_of(const Tape& tape) {
  InternalRasterizerOptions options;
  options.tuning.path = RasterPath::plain;
  InternalRasterizer rasterizer(options);
  tape.play(rasterizer);
  return rasterizer.counts().fragments;
}

void rasterizing(benchmark::State& state, const SceneName& name) {
  const Prepared p = prepare(name, true, For::picture);
  Tape tape;
  GeometryClocks clocks;
  run_geometry(p.scene, p.setup, p.options, tape, clocks);
  InternalRasterizer rasterizer({});
  for (auto _ : state) {
    tape.play(rasterizer);
    benchmark::DoNotOptimize(rasterizer.take());
  }
  state.counters["Mtri/s"] = Counter(static_cast<double>(tape.count()) * 1e-6, k_rate);
  state.counters["Mpix/s"] = Counter(static_cast<double>(fragments_of(tape)) * 1e-6, k_rate);
}

}  // namespace
}  // namespace farop

int main(int argc, char** argv) {
  using namespace farop;
  for (const SceneName& scene : k_scenes) {
    const std::string name = std::string("/") + scene.name + "-" + std::to_string(scene.size);
    const auto add = [&](const char* stage, void (*run)(benchmark::State&, const SceneName&)) {
      benchmark::RegisterBenchmark((stage + name).c_str(), run, scene)->Unit(benchmark::kMillisecond);
    };
    add("parse", parsing);
    benchmark::RegisterBenchmark(("parse_2_threads" + name).c_str(), parsing_on_two_threads, scene)
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
    add("geometry", geometry);
    add("flat_write", flat_writing);
    add("flat_read", flat_reading);
    add("raster", rasterizing);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
