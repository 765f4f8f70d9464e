// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/plain_stage.h"

#include "scene/plane.h"
#include "shading/shade.h"

namespace farop {

PlainStage::PlainStage(const GeometrySetup& setup, const GeometryOptions& options, const PolygonWants& wants)
    : setup_(setup),
      options_(options),
      wants_(wants),
      mapping_(setup.device_mapping()),
      frustum_(setup.frustum()),
      triangles_only_(options.triangles || wants.triangles) {}

// The steps, in the paper's order.
void PlainStage::polygon(const PlacedSurface& placed, const PolygonView& polygon, ScreenPolygonBatch& batch,
                         PolygonCounts& counts) {
  ++counts.loaded;
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

  const std::size_t first = batch.vertices.size();
  append_vertices(surface, polygon, flat, batch);
  if (triangles_only_) {
    positions_.clear();
    for (const EyeVertex& vertex : ring_) positions_.push_back(vertex.position);
    append_triangles(positions_, normal_eye, placed, faces_away, batch, counts);
  } else {
    append_record(first, ring_.size(), placed, faces_away, batch);
  }
}

void PlainStage::load_eye_vertices(const PlacedSurface& placed, const PolygonView& polygon,
                                   const V3d& normal_eye, bool faces_away) {
  const Surface& surface = placed.surface;
  const std::vector<V3d>* own = placed.vertex_normals(polygon.has_given_normals);
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
      if (polygon.has_given_normals && surface.normal_rule == NormalRule::nff && normal.dot(normal_eye) < 0) {
        normal = -normal;
      }
    }
    if (faces_away) normal = -normal;
    ring_.push_back({surface.positions[v] * placed.local_to_eye, normal, corner});
    if (!surface.textures.empty()) ring_.back().texture = V3d(surface.textures[v]);
  }
}

Shaded PlainStage::light(const Surface& surface, const EyeVertex& vertex) const {
  if (options_.unlit) return {};
  return shade(surface.shader.get(), surface.material, vertex.position, vertex.normal, vertex.texture,
               setup_.shading);
}

// Lights and projects the clipped ring into the batch.
void PlainStage::append_vertices(const Surface& surface, const PolygonView& polygon, const Shaded& flat,
                                 ScreenPolygonBatch& batch) const {
  for (const EyeVertex& vertex : ring_) {
    const Shaded shaded = options_.flat ? flat : light(surface, vertex);
    batch.vertices.push_back(mapping_.to_device(vertex.position, shaded.color));
    if (wants_.opacities) {
      const Rgb o = clamp01(shaded.opacity);
      batch.opacities.emplace_back(V3d(o.r, o.g, o.b));
    }
    if (wants_.textures) batch.textures.emplace_back(vertex.texture);
    if (wants_.normals) batch.normals.emplace_back(vertex.normal);
    if (wants_.eye_positions) batch.eye_positions.emplace_back(vertex.position);
    if (wants_.vertex_ids) {
      batch.vertex_ids.push_back(vertex.source == k_clip_made ? k_no_vertex_id
                                                              : polygon.corners[vertex.source]);
    }
  }
}

void PlainStage::append_record(std::size_t first, std::size_t count, const PlacedSurface& placed,
                               bool faces_away, ScreenPolygonBatch& batch) {
  batch.polygons.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
                            &placed.surface.material, faces_away, placed.surface_id, placed.object_id,
                            placed.surface.shader.get()});
}

void PlainStage::append_triangles(std::span<const V3d> positions, const V3d& normal_eye,
                                  const PlacedSurface& placed, bool faces_away, ScreenPolygonBatch& batch,
                                  PolygonCounts& counts) {
  const std::size_t first = batch.vertices.size() - positions.size();
  if (positions.size() == 3) {
    append_record(first, 3, placed, faces_away, batch);
    ++counts.triangles;
    return;
  }
  ++counts.split_to_triangles;
  triangulate(positions, normal_eye, triangles_, triangulate_scratch_);
  counts.triangles += triangles_.size();
  for (const CornerTriangle& triangle : triangles_) {
    const std::size_t start = batch.vertices.size();
    for (const std::uint32_t corner : triangle) {
      batch.vertices.push_back(ScreenVertex(batch.vertices[first + corner]));
      if (wants_.normals) batch.normals.push_back(V3f(batch.normals[first + corner]));
      if (wants_.eye_positions) batch.eye_positions.push_back(V3f(batch.eye_positions[first + corner]));
      if (wants_.vertex_ids) {
        batch.vertex_ids.push_back(std::uint32_t{batch.vertex_ids[first + corner]});
      }
      if (wants_.textures) batch.textures.push_back(V3f(batch.textures[first + corner]));
      if (wants_.opacities) batch.opacities.push_back(V3f(batch.opacities[first + corner]));
    }
    append_record(start, 3, placed, faces_away, batch);
  }
}

}  // namespace farop
