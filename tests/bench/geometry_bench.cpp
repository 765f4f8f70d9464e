// SPDX-License-Identifier: GPL-3.0-or-later
// Speed of the geometry stage: its batched path beside the plain one, on one thread and on several; vertices
// alone, moved, lit and projected; and triangulation of polygons of very many corners.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "geometry/batched/lighting.h"
#include "geometry/pipeline.h"
#include "geometry/placed_surface.h"
#include "geometry/triangulate.h"
#include "parse_nff/parse_nff.h"
#include "scene/merge.h"
#include "scene/tessellate.h"
#include "shading/shade.h"
#include "spd/spd.h"

namespace farop {
namespace {

using benchmark::Counter;
constexpr auto k_rate = Counter::kIsIterationInvariantRate;

Viewport viewport() {
  Viewport viewport;
  viewport.resolution = {1024, 1024, std::int64_t{1} << 24, 256};
  viewport.pixel_fit = PixelFit::edges;
  viewport.subpixel_bits = 8;
  viewport.half_pixel_border = true;
  return viewport;
}

// --------------------------------------------------------------------------------------------- the whole
// stage

struct Frame {
  Scene scene;
  GeometrySetup setup;
};

const Frame& frame_of(const std::string& name, int size) {
  static std::map<std::string, Frame> frames;
  Frame& frame = frames[name + std::to_string(size)];
  if (!frame.scene.root.children.empty()) return frame;
  SpdRequest request;
  request.name = name;
  request.size = size;
  std::string text;
  write_spd(request, [&](std::string_view block) { text += block; });
  WordReader reader(text, "bench");
  DiagnosticList messages;
  frame.scene = parse_nff(reader, messages).value();
  tessellate_scene(frame.scene, {3, std::nullopt});
  frame.setup = prepare_geometry(frame.scene, complete_camera(frame.scene.view, messages), viewport(),
                                 GeometryOptions{});
  return frame;
}

class Nothing : public ScreenPolygonSink {
 public:
  void begin_frame(const ScreenFrame&) override {}
  void polygons(const ScreenPolygonBatch& batch) override { benchmark::DoNotOptimize(batch.vertices.data()); }
  void end_frame() override {}
};

void whole_stage(benchmark::State& state, const std::string& name, int size, GeometryPath path, int threads) {
  const Frame& frame = frame_of(name, size);
  GeometryOptions options;
  options.path = path, options.threads = threads;
  Nothing nothing;
  PolygonCounts counts;
  for (auto _ : state) {
    GeometryClocks clocks;
    counts = run_geometry(frame.scene, frame.setup, options, nothing, clocks).counts;
  }
  state.counters["Mvertices/s"] = Counter(static_cast<double>(counts.vertices) * 1e-6, k_rate);
  state.counters["Mpolygons/s"] = Counter(static_cast<double>(counts.loaded) * 1e-6, k_rate);
}

// ------------------------------------------------------------------------------------------- vertices alone

/// A sphere of vertices with normals before the eye, under one light.
struct Vertices {
  std::vector<V3d> positions, normals;
  M44d to_eye;
  Material material;
  ShadingFrame shading;

  Vertices(std::size_t count, bool highlights) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    for (std::size_t i = 0; i < count; ++i) {
      const V3d normal = V3d(u(random), u(random), u(random)).normalized();
      normals.push_back(normal);
      positions.push_back(normal * 2.0);
    }
    to_eye.rotate(V3d(0.3, 0.4, 0.5));
    to_eye.translate(V3d(0.1, 0.2, 6));
    material.ks = highlights ? 0.4 : 0;
    material.shine = 27.8;
    LightSource light;
    light.position = V3d(5, 5, -5);
    shading.lights.push_back(light);
  }
};

const DeviceMapping k_mapping(viewport(), {0.6, 0.6}, 1, 20);
constexpr Frustum k_frustum{0.6, 0.6, 1, 20};

void plain_vertices(benchmark::State& state) {
  const Vertices v(static_cast<std::size_t>(state.range(0)), state.range(1) != 0);
  std::vector<ScreenVertex> out(v.positions.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const V3d position = v.positions[i] * v.to_eye;
      const V3d normal = PlacedSurface::direction(v.normals[i], v.to_eye);
      const Shaded shaded = shade(nullptr, v.material, position, normal, V3d(0, 0, 0), v.shading);
      out[i] = k_mapping.to_device(position, shaded.color);
    }
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.counters["Mvertices/s"] = Counter(static_cast<double>(out.size()) * 1e-6, k_rate);
}

constexpr std::size_t k_chunk = 1024;

struct alignas(batched::k_alignment) ChunkArrays {
  double values[6][k_chunk];
  std::int32_t x[k_chunk], y[k_chunk], z[k_chunk];
  std::uint32_t red_green[k_chunk], blue[k_chunk], codes[k_chunk];
};

void batched_vertices(benchmark::State& state) {
  const Vertices v(static_cast<std::size_t>(state.range(0)), state.range(1) != 0);
  std::vector<ScreenVertex> out(v.positions.size());
  const auto chunk = std::make_unique<ChunkArrays>();
  auto& [values, x, y, z, red_green, blue, codes] = *chunk;
  batched::Lighting lighting(v.shading, k_mapping);
  const batched::LitArrays arrays{
      {values[0], values[1], values[2]}, {values[3], values[4], values[5]}, red_green, blue};
  for (auto _ : state) {
    for (std::size_t first = 0; first < out.size(); first += k_chunk) {
      const std::size_t count = std::min(k_chunk, out.size() - first);
      for (std::size_t i = 0; i < count; ++i) {
        const V3d &p = v.positions[first + i], &n = v.normals[first + i];
        values[0][i] = p.x, values[1][i] = p.y, values[2][i] = p.z;
        values[3][i] = n.x, values[4][i] = n.y, values[5][i] = n.z;
      }
      batched::transform_points(v.to_eye, k_frustum, count, arrays.points, codes);
      batched::transform_directions(v.to_eye, count, arrays.normals);
      batched::project(k_mapping.terms(), count, arrays.points, x, y, z);
      lighting.by_material(v.material, count, arrays);
      for (std::size_t i = 0; i < count; ++i) {
        ScreenVertex& o = out[first + i];
        o.x = x[i], o.y = y[i], o.z = z[i];
        o.r = static_cast<std::uint16_t>(red_green[i]);
        o.g = static_cast<std::uint16_t>(red_green[i] >> 16);
        o.b = static_cast<std::uint16_t>(blue[i]);
      }
    }
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.counters["Mvertices/s"] = Counter(static_cast<double>(out.size()) * 1e-6, k_rate);
}

// --------------------------------------------------------------------------------------------- triangulation

enum class Shape { circle, star, spiral, noise };

std::vector<V3d> polygon(Shape shape, int corners) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0.2, 1);
  std::vector<V3d> ring;
  const int half = corners / 2;
  for (int i = 0; i < corners; ++i) {
    double angle = 2 * std::numbers::pi * i / corners, r = 1;
    if (shape == Shape::star) r = i % 2 == 0 ? 1 : 0.5;
    if (shape == Shape::noise) r = u(random);
    if (shape == Shape::spiral) {  // a band that winds ten times and comes back beside itself
      const double along = i < half ? i : corners - 1 - i;
      angle = 20 * std::numbers::pi * along / half;
      r = (i < half ? 1 : 0.98) * (0.2 + along / half);
    }
    ring.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
  }
  return ring;
}

void triangulation(benchmark::State& state, Shape shape) {
  const std::vector<V3d> ring = polygon(shape, static_cast<int>(state.range(0)));
  std::vector<CornerTriangle> triangles;
  TriangulateScratch scratch;
  for (auto _ : state) {
    triangulate(ring, V3d(0, 0, 1), triangles, scratch);
    benchmark::DoNotOptimize(triangles.data());
  }
  state.SetComplexityN(state.range(0));
}

}  // namespace
}  // namespace farop

int main(int argc, char** argv) {
  using namespace farop;
  const auto in_milliseconds = [](const std::string& name, auto run) {
    return benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
  };
  struct {
    const char* name;
    int size;
  } constexpr scenes[] = {{"gears", 4}, {"gears", 8}, {"tetra", 8}, {"mount", 8}, {"balls", 4}};
  for (const auto& [name, size] : scenes) {
    const auto add = [&, n = std::string(name), s = size](const char* what, GeometryPath path, int threads) {
      return in_milliseconds(what + ("/" + n) + "-" + std::to_string(s),
                             [=](benchmark::State& state) { whole_stage(state, n, s, path, threads); });
    };
    add("plain", GeometryPath::plain, 1);
    add("batched", GeometryPath::batched, 1);
    add("one_thread", GeometryPath::batched, 1)->UseRealTime();
    add("two_threads", GeometryPath::batched, 2)->UseRealTime();
  }
  for (auto* b : {benchmark::RegisterBenchmark("plain_vertices", plain_vertices),
                  benchmark::RegisterBenchmark("batched_vertices", batched_vertices)}) {
    b->ArgNames({"vertices", "highlights"})->ArgsProduct({{10'000, 1'000'000}, {0, 1}});
  }
  constexpr std::pair<const char*, Shape> shapes[] = {
      {"circle", Shape::circle}, {"star", Shape::star}, {"spiral", Shape::spiral}, {"noise", Shape::noise}};
  for (const auto& [name, shape] : shapes) {
    in_milliseconds("triangulate/" + std::string(name), [s = shape](auto& state) { triangulation(state, s); })
        ->RangeMultiplier(10)
        ->Range(1000, 100'000)
        ->Complexity();
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
