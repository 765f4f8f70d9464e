// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangle_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string_view>

#include "geometry/pipeline.h"
#include "parse_nff/parse_nff.h"
#include "scene/merge.h"
#include "scene/tessellate.h"
#include "spd/spd.h"

namespace farop::bench {
namespace {

constexpr int k_size = 1024, k_bits = 8;
constexpr std::size_t k_batch_corners = 4096;  // as the geometry stage hands them over

struct SoupName {
  const char* name;
  int triangles;
  double area;  ///< of each, pixels
};
constexpr SoupName k_soups[] = {
    {"1 M tiny", 1000000, 2}, {"100 k medium", 100000, 100}, {"1 k large", 1000, 50000}};
struct SpdName {
  const char* name;
  const char* scene;
  int size;
};
constexpr SpdName k_spd[] = {{"gears 4", "gears", 4},
                             {"gears 8", "gears", 8},
                             {"teapot 12", "teapot", 12},
                             {"tetra 8", "tetra", 8},
                             {"mount 8", "mount", 8}};

class Recorder : public ScreenPolygonSink {
 public:
  explicit Recorder(TriangleScene& scene) : scene_(scene) {}
  PolygonWants wants() const override {
    PolygonWants wants;
    wants.triangles = true;
    return wants;
  }
  void begin_frame(const ScreenFrame& frame) override { scene_.frame = frame; }
  void polygons(const ScreenPolygonBatch& batch) override {
    scene_.batches.push_back(batch);
    for (ScreenPolygonRecord& record : scene_.batches.back().polygons) {
      record.material = nullptr, record.shader = nullptr;  // opaque: not every rasterizer can do more
    }
  }
  void end_frame() override {}

 private:
  TriangleScene& scene_;
};

Viewport viewport() {
  Viewport v;
  v.resolution = {k_size, k_size, std::int64_t{1} << 24, 256};
  v.pixel_fit = PixelFit::edges;
  v.subpixel_bits = k_bits;
  v.half_pixel_border = true;
  return v;
}

void run(const SpdName& which, TriangleScene& out) {
  SpdRequest request;
  request.name = which.scene, request.size = which.size;
  std::string text;
  write_spd(request, [&](std::string_view block) { text += block; });
  WordReader reader(text, which.scene);
  DiagnosticList messages;
  Scene scene = parse_nff(reader, messages).value();
  tessellate_scene(scene, {3, std::nullopt});
  const GeometryOptions options;
  const GeometrySetup setup =
      prepare_geometry(scene, complete_camera(scene.view, messages), viewport(), options);
  Recorder recorder(out);
  GeometryClocks clocks;
  run_geometry(scene, setup, options, recorder, clocks);
}

/// Triangles of one area and all directions, equal sides give or take a third, wholly inside the frame.
void fill(const SoupName& which, TriangleScene& out) {
  out.frame = viewport().frame();
  std::mt19937_64 random(1997);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const double radius = std::sqrt(which.area / (0.75 * std::numbers::sqrt3));
  ScreenPolygonBatch batch;
  for (int i = 0; i < which.triangles; ++i) {
    if (batch.vertices.size() >= k_batch_corners) out.batches.push_back(batch), batch.clear();
    const double x = number(radius, k_size - radius), y = number(radius, k_size - radius);
    const double turn = number(0, 2 * std::numbers::pi), z = number(0.05, 0.95) * (1 << 24);
    ScreenPolygonRecord record;
    record.first_vertex = static_cast<std::uint32_t>(batch.vertices.size());
    record.vertex_count = 3;
    batch.polygons.push_back(record);
    for (int k = 0; k < 3; ++k) {
      const double angle = turn + 2 * std::numbers::pi * (k + number(-1, 1) / 12) / 3;
      const auto component = [&] { return static_cast<std::uint16_t>(number(0, 256)); };
      ScreenVertex v;
      v.x = static_cast<std::int32_t>(std::clamp((x + radius * std::cos(angle)) * 256, 0.0, 1023.0 * 256));
      v.y = static_cast<std::int32_t>(std::clamp((y + radius * std::sin(angle)) * 256, 0.0, 1023.0 * 256));
      v.z = static_cast<std::int32_t>(z + number(-0.04, 0.04) * (1 << 24));
      v.r = component(), v.g = component(), v.b = component();
      batch.vertices.push_back(v);
    }
  }
  out.batches.push_back(batch);
}

}  // namespace

std::size_t TriangleScene::triangles() const {
  std::size_t n = 0;
  for (const ScreenPolygonBatch& batch : batches) n += batch.polygons.size();
  return n;
}

void TriangleScene::play(ScreenPolygonSink& sink) const {
  sink.begin_frame(frame);
  for (const ScreenPolygonBatch& batch : batches) sink.polygons(batch);
  sink.end_frame();
}

std::vector<std::string> triangle_scene_names() {
  std::vector<std::string> names;
  for (const SpdName& spd : k_spd) names.emplace_back(spd.name);
  for (const SoupName& soup : k_soups) names.emplace_back(soup.name);
  return names;
}

TriangleScene make_triangle_scene(const std::string& name) {
  TriangleScene scene;
  scene.name = name;
  for (const SpdName& spd : k_spd) {
    if (name == spd.name) run(spd, scene);
  }
  for (const SoupName& soup : k_soups) {
    if (name == soup.name) fill(soup, scene);
  }
  return scene;
}

}  // namespace farop::bench
