// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles of polygons that have no scene behind them any more: those of a flat file.
#pragma once

#include <vector>

#include "core/screen_polygon.h"
#include "geometry/triangulate.h"

namespace farop {

/// Hands on every polygon of more than three corners as the triangles that triangulate()
/// (geometry/triangulate.h) cuts it into on the screen, in exact arithmetic; all corners keep their values. A
/// polygon that rounding to the grid has made cross itself is cut all the same; then its triangles may cover
/// other samples than it did.
class ScreenTriangles : public ScreenPolygonSink {
 public:
  explicit ScreenTriangles(ScreenPolygonSink& next) : next_(next) {}

  PolygonWants wants() const override { return next_.wants(); }
  void begin_frame(const ScreenFrame& frame) override;
  void polygons(const ScreenPolygonBatch& batch) override;
  void end_frame() override { next_.end_frame(); }

 private:
  ScreenPolygonSink& next_;
  ScreenPolygonBatch split_;
  std::vector<V3d> positions_;
  std::vector<CornerTriangle> triangles_;
  TriangulateScratch scratch_;
};

}  // namespace farop
