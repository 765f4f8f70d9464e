// SPDX-License-Identifier: GPL-3.0-or-later
// The geometry stage for many polygons of a surface at once.
//
// Does:      look at planes before any vertex is touched; move, project and light vertices as arrays, those
//            that polygons share once where they have normals of their own; hand over what the plain path
//            does, bit for bit.
// Does not:  clip, or take polygons of very many corners, itself: PlainStage does, one by one, in between.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/screen_polygon.h"
#include "core/statistics.h"
#include "geometry/batched/lighting.h"
#include "geometry/batched/polygon_planes.h"
#include "geometry/pipeline.h"
#include "geometry/placed_surface.h"
#include "geometry/plain_stage.h"
#include "scene/surface.h"

namespace farop::batched {

/// Consecutive polygons of a surface.
struct Piece {
  const PlacedSurface* placed = nullptr;
  PolygonList::Iterator first;
  std::uint64_t polygons = 0;
};

/// One per thread.
class BatchedStage {
 public:
  /// All three must outlive the stage.
  BatchedStage(const GeometrySetup& setup, const GeometryOptions& options, const PolygonWants& wants);
  ~BatchedStage();
  BatchedStage(const BatchedStage&) = delete;
  BatchedStage& operator=(const BatchedStage&) = delete;

  /// Takes polygons from the front of `piece`, appends what is left of them to `batch` and adds them to
  /// `counts`, until the piece is used up or the batch has `enough` corners.
  void run(Piece& piece, std::size_t enough, ScreenPolygonBatch& batch, PolygonCounts& counts);

 private:
  struct Arrays;
  enum class Normals : std::uint8_t { of_plane, given, averaged };
  struct Corners {
    const std::uint32_t* vertices = nullptr;
    std::uint32_t count = 0;
  };
  /// A polygon that is not culled.
  struct Survivor {
    Corners corners;
    std::uint32_t first_corner = 0;  ///< among the corners of the chunk
    std::uint32_t plane = 0;         ///< its number among the planes of survivors
    bool faces_away = false;
    bool cut = false;  ///< partly outside: left to PlainStage
  };

  void take_chunk(Piece& piece);
  void run_chunk(ScreenPolygonBatch& batch, PolygonCounts& counts);
  // The steps, in order.
  void cull(PolygonCounts& counts);
  void collect_items();
  void drop_outside(PolygonCounts& counts);
  void find_normals();
  void light_items();
  void append(ScreenPolygonBatch& batch, PolygonCounts& counts);

  std::span<const Survivor> survivors() const;
  void turn_normals(bool towards_front);
  std::uint32_t copy_item(std::uint32_t item, const V3d& normal);
  // For survivors by number.
  void append_inside(std::size_t first, std::size_t end, ScreenPolygonBatch& batch, PolygonCounts& counts);
  void write_vertices(std::size_t survivor, ScreenVertex* out) const;
  void append_attributes(std::size_t survivor, ScreenPolygonBatch& batch) const;

  const GeometryOptions& options_;
  const PolygonWants& wants_;
  DeviceMapping mapping_;
  Frustum frustum_;
  bool triangles_only_;
  PlainStage plain_;
  Lighting lighting_;

  // The chunk being worked on: polygons of one surface whose normals come from one place.
  const PlacedSurface* placed_ = nullptr;
  Normals kind_ = Normals::of_plane;
  PolygonPlanes planes_;
  std::size_t polygons_ = 0, survivors_ = 0, items_ = 0;
  std::unique_ptr<Arrays> a_;
  std::vector<V3d> positions_;
};

}  // namespace farop::batched
