// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/screen_triangles.h"

namespace farop {

void ScreenTriangles::begin_frame(const ScreenFrame& frame) {
  ScreenFrame triangles = frame;
  if (triangles.max_vertices != 0) triangles.max_vertices = 3;
  next_.begin_frame(triangles);
}

void ScreenTriangles::polygons(const ScreenPolygonBatch& batch) {
  split_.clear();
  const auto copy = [&](std::size_t from) {
    split_.vertices.push_back(batch.vertices[from]);
    if (!batch.normals.empty()) split_.normals.push_back(batch.normals[from]);
    if (!batch.eye_positions.empty()) split_.eye_positions.push_back(batch.eye_positions[from]);
    if (!batch.vertex_ids.empty()) split_.vertex_ids.push_back(batch.vertex_ids[from]);
  };
  for (const ScreenPolygonRecord& record : batch.polygons) {
    triangles_.clear();
    if (record.vertex_count == 3) {
      triangles_.push_back({0, 1, 2});
    } else {
      positions_.clear();
      for (const ScreenVertex& v : batch.corners(record)) positions_.emplace_back(v.x, v.y, 0);
      triangulate(positions_, V3d(0, 0, 1), triangles_, scratch_);
    }
    for (const CornerTriangle& triangle : triangles_) {
      ScreenPolygonRecord piece = record;
      piece.first_vertex = static_cast<std::uint32_t>(split_.vertices.size());
      piece.vertex_count = 3;
      for (const std::uint32_t corner : triangle) copy(std::size_t{record.first_vertex} + corner);
      split_.polygons.push_back(piece);
    }
  }
  next_.polygons(split_);
}

}  // namespace farop
