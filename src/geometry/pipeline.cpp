// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "geometry/clip.h"
#include "geometry/triangulate.h"
#include "scene/plane.h"
#include "scene/traverse.h"
#include "shading/shade.h"

namespace farop {
namespace {

/// Corners per batch: long enough that a clock reading per batch costs nothing, short enough to stay in the
/// L2 cache.
constexpr std::size_t k_batch_corners = 4096;
/// Polygons between two calls of the progress function.
constexpr std::uint64_t k_progress_step = 1u << 14;

struct DepthRange {
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -std::numeric_limits<double>::infinity();
};

/// Of all vertices, along the view direction.
DepthRange vertex_depths(const Scene& scene, const M44d& world_to_eye) {
  DepthRange range;
  for_each_surface(scene, [&](const SurfacePlacement& placement) {
    const M44d m = placement.local_to_world * world_to_eye;
    for (const V3d& p : placement.surface.positions) {
      const double depth = p.x * m[0][2] + p.y * m[1][2] + p.z * m[2][2] + m[3][2];
      range.nearest = std::min(range.nearest, depth);
      range.farthest = std::max(range.farthest, depth);
    }
  });
  return range;
}

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

/// A surface in its place: the matrices its polygons need.
struct PlacedSurface {
  PlacedSurface(const SurfacePlacement& placement, const M44d& world_to_eye, const V3d& eye_world)
      : surface(placement.surface),
        surface_id(placement.surface_id),
        object_id(placement.object_id),
        local_to_eye(placement.local_to_world * world_to_eye) {
    const M44d& local_to_world = placement.local_to_world;
    if (surface.normal_rule == NormalRule::sipp) vertex_normal_to_eye = local_to_eye;
    if (local_to_world == M44d()) {
      eye_local = eye_world;
      normal_to_eye = world_to_eye;  // orthonormal: its own inverse transpose
    } else {
      const double volume = local_to_world.determinant();
      flattened = volume == 0;
      mirrored = volume < 0;
      eye_local = eye_world * local_to_world.inverse();
      normal_to_eye = local_to_eye.inverse().transposed();
    }
    if (surface.normal_rule == NormalRule::nff) vertex_normal_to_eye = normal_to_eye;
  }

  static V3d direction(const V3d& local, const M44d& matrix) {
    V3d out;
    matrix.multDirMatrix(local, out);
    return out.normalized();
  }

  const Surface& surface;
  std::uint32_t surface_id, object_id;
  M44d local_to_eye;
  M44d normal_to_eye;         ///< of planes
  M44d vertex_normal_to_eye;  ///< of vertex normals, by the surface's rule
  V3d eye_local;
  bool flattened = false;  ///< the matrix leaves no volume: no side to see
  bool mirrored = false;   ///< fronts run clockwise once they have been moved
};

class Stage {
 public:
  Stage(const GeometrySetup& setup, const GeometryOptions& options, ScreenPolygonSink& sink,
        GeometryClocks& clocks)
      : setup_(setup),
        options_(options),
        sink_(sink),
        clocks_(clocks),
        mapping_(setup.viewport, setup.tangents, setup.nearest_depth, setup.farthest_depth),
        frustum_{setup.tangents.x, setup.tangents.y, setup.hither, setup.yon},
        wants_(sink.wants()),
        triangles_only_(options.triangles || wants_.triangles) {}

  void surface(const PlacedSurface& placed, const std::function<void()>& tick) {
    for (const PolygonView polygon : placed.surface.polygons) {
      this->polygon(placed, polygon);
      if (++counts.loaded % k_progress_step == 0) tick();
    }
  }

  void flush() {
    if (batch_.polygons.empty()) return;
    clocks_.geometry.stop();
    {
      const TimedSlice slice(clocks_.sink);
      sink_.polygons(batch_);
    }
    clocks_.geometry.start();
    batch_.clear();
  }

  PolygonCounts counts;

 private:
  // The steps, in the paper's order.
  void polygon(const PlacedSurface& placed, const PolygonView& polygon) {
    const Surface& surface = placed.surface;
    const std::optional<V3d> normal = plane_normal(surface.positions, polygon.corners);
    if (!normal || placed.flattened) {
      ++counts.degenerate;
      return;
    }
    const V3d& on_plane = surface.positions[polygon.corners.front()];
    const bool faces_away = normal->dot(on_plane - placed.eye_local) >= 0;
    if (faces_away && !options_.two_sided) {
      ++counts.back_facing;
      return;
    }
    const V3d normal_eye = PlacedSurface::direction(*normal, placed.normal_to_eye);
    load_eye_vertices(placed, polygon, normal_eye, faces_away);
    Shaded flat;
    if (options_.flat) flat = light(surface, ring_.front());  // before clipping may take it away
    const ClipResult clipped = clip_to_frustum(ring_, frustum_, clip_scratch_);
    if (clipped == ClipResult::outside) {
      ++counts.totally_clipped;
      return;
    }
    ++counts.rendered;
    if (clipped == ClipResult::partly) ++counts.partly_clipped;
    counts.vertices += ring_.size();

    const std::size_t first = append_vertices(surface, polygon, flat);
    if (triangles_only_) {
      append_triangles(first, normal_eye, placed, faces_away);
    } else {
      append_record(first, ring_.size(), placed, faces_away);
    }
    if (batch_.vertices.size() >= k_batch_corners) flush();
  }

  void load_eye_vertices(const PlacedSurface& placed, const PolygonView& polygon, const V3d& normal_eye,
                         bool faces_away) {
    const Surface& surface = placed.surface;
    const std::vector<V3d>* own = polygon.has_given_normals          ? &surface.normals
                                  : surface.averaged_normals.empty() ? nullptr
                                                                     : &surface.averaged_normals;
    ring_.clear();
    const auto corners = static_cast<std::uint32_t>(polygon.corners.size());
    for (std::uint32_t i = 0; i < corners; ++i) {
      // The first stays the first; of a mirrored polygon the others come the other way round.
      const std::uint32_t corner = placed.mirrored && i > 0 ? corners - i : i;
      const std::uint32_t v = polygon.corners[corner];
      V3d normal = normal_eye;
      if (own != nullptr) {
        normal = PlacedSurface::direction((*own)[v], placed.vertex_normal_to_eye);
        if (normal == V3d(0, 0, 0)) normal = normal_eye;
        // A given NFF normal may point to the back of its polygon (SPD nurbtst): it lights the front all the
        // same.
        if (polygon.has_given_normals && surface.normal_rule == NormalRule::nff &&
            normal.dot(normal_eye) < 0) {
          normal = -normal;
        }
      }
      if (faces_away) normal = -normal;
      ring_.push_back({surface.positions[v] * placed.local_to_eye, normal, corner});
      if (!surface.textures.empty()) ring_.back().texture = V3d(surface.textures[v]);
    }
  }

  Shaded light(const Surface& surface, const EyeVertex& vertex) const {
    if (options_.unlit) return {};
    return shade(surface.shader.get(), surface.material, vertex.position, vertex.normal, vertex.texture,
                 setup_.shading);
  }

  // Lights and projects the clipped ring into the batch; returns the index of its first vertex.
  std::size_t append_vertices(const Surface& surface, const PolygonView& polygon, const Shaded& flat) {
    const std::size_t first = batch_.vertices.size();
    for (const EyeVertex& vertex : ring_) {
      const Shaded shaded = options_.flat ? flat : light(surface, vertex);
      batch_.vertices.push_back(mapping_.to_device(vertex.position, shaded.color));
      if (wants_.opacities) {
        const Rgb o = clamp01(shaded.opacity);
        batch_.opacities.emplace_back(V3d(o.r, o.g, o.b));
      }
      if (wants_.textures) batch_.textures.emplace_back(vertex.texture);
      if (wants_.normals) batch_.normals.emplace_back(vertex.normal);
      if (wants_.eye_positions) batch_.eye_positions.emplace_back(vertex.position);
      if (wants_.vertex_ids) {
        batch_.vertex_ids.push_back(vertex.source == k_clip_made ? k_no_vertex_id
                                                                 : polygon.corners[vertex.source]);
      }
    }
    return first;
  }

  void append_record(std::size_t first, std::size_t count, const PlacedSurface& placed, bool faces_away) {
    batch_.polygons.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
                               &placed.surface.material, faces_away, placed.surface_id, placed.object_id,
                               placed.surface.shader.get()});
  }

  // Triangles take their own copies of the polygon's vertices, behind them in the batch; no attribute
  // changes.
  void append_triangles(std::size_t first, const V3d& normal_eye, const PlacedSurface& placed,
                        bool faces_away) {
    const std::size_t corners = ring_.size();
    if (corners == 3) {
      append_record(first, 3, placed, faces_away);
      ++counts.triangles;
      return;
    }
    ++counts.split_to_triangles;
    positions_.clear();
    for (const EyeVertex& vertex : ring_) positions_.push_back(vertex.position);
    triangulate(positions_, normal_eye, triangles_, triangulate_scratch_);
    counts.triangles += triangles_.size();
    for (const CornerTriangle& triangle : triangles_) {
      const std::size_t start = batch_.vertices.size();
      for (const std::uint32_t corner : triangle) {
        batch_.vertices.push_back(ScreenVertex(batch_.vertices[first + corner]));
        if (wants_.normals) batch_.normals.push_back(V3f(batch_.normals[first + corner]));
        if (wants_.eye_positions) batch_.eye_positions.push_back(V3f(batch_.eye_positions[first + corner]));
        if (wants_.vertex_ids) {
          batch_.vertex_ids.push_back(std::uint32_t{batch_.vertex_ids[first + corner]});
        }
        if (wants_.textures) batch_.textures.push_back(V3f(batch_.textures[first + corner]));
        if (wants_.opacities) batch_.opacities.push_back(V3f(batch_.opacities[first + corner]));
      }
      append_record(start, 3, placed, faces_away);
    }
  }

  const GeometrySetup& setup_;
  const GeometryOptions& options_;
  ScreenPolygonSink& sink_;
  GeometryClocks& clocks_;
  DeviceMapping mapping_;
  Frustum frustum_;
  PolygonWants wants_;
  bool triangles_only_;

  ScreenPolygonBatch batch_;
  std::vector<EyeVertex> ring_;
  ClipScratch clip_scratch_;
  std::vector<V3d> positions_;
  std::vector<CornerTriangle> triangles_;
  TriangulateScratch triangulate_scratch_;
};

}  // namespace

GeometrySetup prepare_geometry(const Scene& scene, const Camera& camera, const Viewport& viewport,
                               const GeometryOptions& options) {
  GeometrySetup setup;
  setup.camera = camera;
  setup.viewport = viewport;
  setup.tangents = view_tangents(camera, viewport);
  setup.hither = camera.near_distance();
  const M44d to_eye = world_to_eye(camera);
  DepthRange depths;
  if (!camera.yon || camera.fit_depth) depths = vertex_depths(scene, to_eye);
  if (camera.yon) {
    setup.yon = *camera.yon;
  } else {
    setup.yon = std::max(0.0, depths.farthest) * 1.000001;
    if (!(setup.yon > setup.hither)) setup.yon = 2 * setup.hither;
  }
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
  GeometryReport report;
  const std::uint64_t total = progress ? totals(scene).polygons : 0;
  const M44d to_eye = world_to_eye(setup.camera);
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
  Stage stage(setup, options, sink, clocks);
  const auto tick = [&] {
    if (progress) progress(stage.counts.loaded, total);
  };
  report.degenerate_of_input.resize(scene.root.children.size());
  for_each_surface(scene, [&](const SurfacePlacement& placement) {
    const std::uint64_t before = stage.counts.degenerate;
    stage.surface(PlacedSurface(placement, to_eye, setup.camera.from), tick);
    report.degenerate_of_input[placement.input] +=
        stage.counts.degenerate - before - placement.surface.cone_tip_triangles;
  });
  stage.flush();
  clocks.geometry.stop();
  {
    const TimedSlice slice(clocks.sink);
    sink.end_frame();
  }
  report.counts = stage.counts;
  return report;
}

}  // namespace farop
