// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "geometry/batched/kernels.h"
#include "geometry/run.h"
#include "scene/traverse.h"

namespace farop {
namespace {

/// The light as it is seen from the eye. Rigid: directions stay unit vectors.
LightSource to_eye_space(const Light& light, const M44d& to_eye, double intensity) {
  LightSource source;
  source.kind = light.kind;
  source.color = light.color.value_or(Rgb{1, 1, 1} * intensity);
  if (light.kind == LightKind::directional) {
    to_eye.multDirMatrix(light.position, source.position);
    return source;
  }
  source.position = light.position * to_eye;
  if (light.kind == LightKind::point) return source;
  to_eye.multDirMatrix((light.target - light.position).normalized(), source.axis);
  source.cos_half_angle = std::cos(light.opening_degrees * (std::numbers::pi / 360));
  return source;
}

/// No polygon has more corners on the screen. A plane leaves a convex polygon one corner more at most; of a
/// concave one it may replace every second corner by two.
std::uint32_t largest_corner_count(const Scene& scene) {
  std::size_t most = 0;
  for_each_surface(scene, [&](const SurfacePlacement& placement) {
    for (const PolygonView polygon : placement.surface.polygons)
      most = std::max(most, polygon.corners.size());
  });
  constexpr int planes = 6;
  if (most <= 3) return 3 + planes;
  for (int i = 0; i < planes; ++i) most += most / 2;
  return static_cast<std::uint32_t>(std::min<std::size_t>(most, std::numeric_limits<std::int32_t>::max()));
}

}  // namespace

DepthRange vertex_depths(const Scene& scene, const Camera& camera) {
  const M44d to_eye = world_to_eye(camera);
  DepthRange range;
  for_each_surface(scene, [&](const SurfacePlacement& placement) {
    const M44d m = placement.local_to_world * to_eye;
    batched::depth_range(placement.surface.positions, m[0][2], m[1][2], m[2][2], m[3][2], range.nearest,
                         range.farthest);
  });
  return range;
}

double auto_yon(double farthest, double hither) {
  const double yon = std::max(0.0, farthest) * 1.000001;
  return yon > hither ? yon : 2 * hither;
}

GeometrySetup prepare_geometry(const Scene& scene, const Camera& camera, const Viewport& viewport,
                               const GeometryOptions& options) {
  GeometrySetup setup;
  setup.camera = camera;
  setup.viewport = viewport;
  setup.tangents = view_tangents(camera, viewport);
  setup.hither = camera.near_distance();
  const M44d to_eye = world_to_eye(camera);
  DepthRange depths;
  if (!camera.yon || camera.fit_depth) depths = vertex_depths(scene, camera);
  setup.yon = camera.yon ? *camera.yon : auto_yon(depths.farthest, setup.hither);
  if (!(setup.yon > setup.hither)) {
    throw Error(ExitStatus::input, fmt::format("yon {} is not beyond hither {}", setup.yon, setup.hither),
                "give a larger --yon, a smaller --hither, or --yon auto");
  }
  setup.nearest_depth = setup.hither, setup.farthest_depth = setup.yon;
  if (camera.fit_depth) {
    const double nearest = std::max(setup.hither, depths.nearest * 0.999999);
    const double farthest = std::min(setup.yon, depths.farthest * 1.000001);
    if (nearest < farthest) setup.nearest_depth = nearest, setup.farthest_depth = farthest;
  }
  for (const Light& light : scene.lights) {
    if (light.active) setup.shading.lights.push_back(to_eye_space(light, to_eye, options.light_intensity));
  }
  if (scene.lights.empty() && options.light_at_eye) setup.shading.lights.push_back({});
  setup.shading.eye_to_world = to_eye.inverse();
  return setup;
}

GeometryReport run_geometry(const Scene& scene, const GeometrySetup& setup, const GeometryOptions& options,
                            ScreenPolygonSink& sink, GeometryClocks& clocks,
                            const ProgressFunction& progress) {
  {
    const TimedSlice slice(clocks.sink);
    ScreenFrame frame = setup.viewport.frame();
    const PolygonWants wants = sink.wants();
    if (wants.max_vertices) {
      frame.max_vertices = options.triangles || wants.triangles ? 3 : largest_corner_count(scene);
    }
    sink.begin_frame(frame);
  }
  clocks.geometry.start();
  GeometryRun run(scene, setup, options, sink, clocks, progress);
  for_each_surface(scene, [&](const SurfacePlacement& placement) { run.surface(placement); });
  GeometryReport report = run.finish();
  clocks.geometry.stop();
  {
    const TimedSlice slice(clocks.sink);
    sink.end_frame();
  }
  return report;
}

}  // namespace farop
