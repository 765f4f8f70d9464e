// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of the geometry stage on one page, polygon by polygon: the readable definition of what the
// batched path (geometry/batched/) hands over too, bit for bit.
//
// Source: the FAROP system (1997), figure 4: per surface polygon normals, back-face removal, vertex normals;
// per polygon clipping, perspective, reflection model, triangulation, device mapping, hand-over.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/screen_polygon.h"
#include "core/statistics.h"
#include "geometry/clip.h"
#include "geometry/pipeline.h"
#include "geometry/placed_surface.h"
#include "geometry/triangulate.h"

namespace farop {

class PlainStage {
 public:
  /// All three must outlive the stage.
  PlainStage(const GeometrySetup& setup, const GeometryOptions& options, const PolygonWants& wants);

  /// All steps for one polygon. Appends what is left of it to `batch`, and adds it to `counts`.
  void polygon(const PlacedSurface& placed, const PolygonView& polygon, ScreenPolygonBatch& batch,
               PolygonCounts& counts);

  /// Cuts the polygon whose vertices are the last of `batch`. `positions` are those of its corners in eye
  /// space. Triangles take their own copies of the vertices, behind them in the batch; no attribute changes.
  void append_triangles(std::span<const V3d> positions, const V3d& normal_eye, const PlacedSurface& placed,
                        bool faces_away, ScreenPolygonBatch& batch, PolygonCounts& counts);

  static void append_record(std::size_t first, std::size_t count, const PlacedSurface& placed,
                            bool faces_away, ScreenPolygonBatch& batch);

 private:
  void load_eye_vertices(const PlacedSurface& placed, const PolygonView& polygon, const V3d& normal_eye,
                         bool faces_away);
  Shaded light(const Surface& surface, const EyeVertex& vertex) const;
  void append_vertices(const Surface& surface, const PolygonView& polygon, const Shaded& flat,
                       ScreenPolygonBatch& batch) const;

  const GeometrySetup& setup_;
  const GeometryOptions& options_;
  const PolygonWants& wants_;
  DeviceMapping mapping_;
  Frustum frustum_;
  bool triangles_only_;

  std::vector<EyeVertex> ring_;
  ClipScratch clip_scratch_;
  std::vector<V3d> positions_;
  std::vector<CornerTriangle> triangles_;
  TriangulateScratch triangulate_scratch_;
};

}  // namespace farop
