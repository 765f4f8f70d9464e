// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugins/solid_scenes.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "core/diagnostics.h"
#include "core/word_reader.h"
#include "geometry/pipeline.h"
#include "parse_nff/parse_nff.h"
#include "scene/traverse.h"

namespace farop::test {
namespace {

/// Keeps what the geometry stage hands over.
class Recorder : public ScreenPolygonSink {
 public:
  void begin_frame(const ScreenFrame&) override {}
  void polygons(const ScreenPolygonBatch& batch) override {
    for (const ScreenPolygonRecord& record : batch.polygons) {
      PluginPolygon polygon;
      for (const ScreenVertex& v : batch.corners(record)) {
        polygon.corners.push_back({v.x, v.y, v.z, static_cast<std::uint8_t>(v.r),
                                   static_cast<std::uint8_t>(v.g), static_cast<std::uint8_t>(v.b), 0});
      }
      if (record.back_facing) polygon.flags |= FAROP_POLYGON_BACK_FACING;
      if (polygon.corners.size() == 3) polygon.flags |= FAROP_POLYGON_CONVEX;
      polygon.object_id = 1;
      polygons_seen.push_back(std::move(polygon));
    }
  }
  void end_frame() override {}

  std::vector<PluginPolygon> polygons_seen;
};

}  // namespace

Scene load_solid(const std::string& name) {
  WordReader reader(std::string(FAROP_SOURCE_DIR) + "/spd_scenes/" + name + ".nff");
  DiagnosticList diagnostics;
  std::optional<Scene> scene = parse_nff(reader, diagnostics);
  if (!scene) throw std::runtime_error(name + " cannot be read");
  return std::move(*scene);
}

Camera own_view(const Scene& scene) {
  Camera camera;
  camera.from = scene.view.from.value(), camera.at = scene.view.at.value(), camera.up = scene.view.up.value();
  camera.angle_degrees = scene.view.angle.value();
  camera.hither = scene.view.hither.value();
  return camera;
}

Camera other_view(const Scene& scene, std::uint64_t number) {
  Camera camera = own_view(scene);
  // The golden angle spreads any number of points evenly over a sphere.
  const double turn = 2.399963229728653 * static_cast<double>(number);
  const double z = std::fmod(0.618033988749895 * static_cast<double>(number) + 0.5, 1.0) * 1.96 - 0.98;
  const double r = std::sqrt(1 - z * z);
  camera.from = camera.at + V3d(r * std::cos(turn), r * std::sin(turn), z) * 7.0;
  return camera;
}

std::vector<PluginPolygon> screen_polygons(const Scene& scene, const Camera& camera,
                                           const SolidRequest& request) {
  Viewport viewport;
  viewport.resolution.x = request.width, viewport.resolution.y = request.height;
  viewport.subpixel_bits = request.subpixel_bits;
  GeometryOptions options;
  options.two_sided = request.two_sided;
  options.flat = request.flat;
  options.triangles = request.triangles;
  const GeometrySetup setup = prepare_geometry(scene, camera, viewport, options);
  Recorder recorder;
  GeometryClocks clocks;
  const GeometryReport report = run_geometry(scene, setup, options, recorder, clocks);
  std::vector<PluginPolygon> polygons = std::move(recorder.polygons_seen);
  const PolygonCounts& counts = report.counts;
  if (!request.two_sided || counts.degenerate + counts.totally_clipped + counts.partly_clipped != 0 ||
      counts.split_to_triangles != 0) {
    return polygons;
  }
  // Every polygon of the scene is there, with all its corners: take the ids from it.
  std::size_t next = 0;
  std::uint32_t surface_id = 0;
  for_each_surface(scene, [&](const SurfacePlacement& placement) {
    const Surface& surface = placement.surface;
    ++surface_id;
    for (const PolygonView polygon : surface.polygons) {
      PluginPolygon& on_screen = polygons.at(next++);
      on_screen.ids.assign(polygon.corners.begin(), polygon.corners.end());
      on_screen.surface_id = surface_id;
      if (on_screen.ids.size() != on_screen.corners.size()) throw std::logic_error("not the same polygon");
    }
  });
  return polygons;
}

}  // namespace farop::test
