// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/batched/batched_stage.h"
#include "geometry/batched/workers.h"
#include "geometry/pipeline.h"
#include "geometry/placed_surface.h"
#include "geometry/plain_stage.h"

namespace farop {

/// The polygons of one frame on their way to the sink: in the order of the tree, cut into units that threads
/// work on, handed on in that order by the thread that calls. Memory: as many units as are worked on at once.
class GeometryRun {
 public:
  /// All must outlive the run. The geometry clock runs while a method does, the sink's meanwhile whenever
  /// the sink does.
  GeometryRun(const Scene& scene, const GeometrySetup& setup, const GeometryOptions& options,
              ScreenPolygonSink& sink, GeometryClocks& clocks, const ProgressFunction& progress);

  void surface(const SurfacePlacement& placement);
  /// Hands over what is left.
  GeometryReport finish();

 private:
  /// What one thread works on at once.
  struct Unit {
    std::vector<batched::Piece> pieces;
    std::size_t corners = 0;
    bool pure = true;  ///< no shader in it minds which thread calls
    ScreenPolygonBatch batch;
    PolygonCounts counts;
    std::vector<std::uint64_t> degenerate;  ///< by piece
  };

  void work_alone(batched::Piece& piece);
  void work_together();
  void work_on(batched::Piece& piece, std::size_t enough, Unit& unit, std::size_t worker);
  void take_counts(Unit& unit);
  void hand_over(ScreenPolygonBatch& batch);
  void show_progress(std::uint64_t before, std::uint64_t now) const;

  const GeometrySetup& setup_;
  ScreenPolygonSink& sink_;
  GeometryClocks& clocks_;
  const ProgressFunction& progress_;
  std::uint64_t total_;
  PolygonWants wants_;
  std::size_t threads_;
  M44d world_to_eye_;
  std::optional<PlainStage> plain_;                             ///< on the plain path
  std::vector<std::unique_ptr<batched::BatchedStage>> stages_;  ///< otherwise one for each thread
  std::optional<batched::Workers> workers_;                     ///< for more than one thread
  std::deque<PlacedSurface> surfaces_;                          ///< those of waiting pieces
  std::vector<Unit> units_;                                     ///< one, never full, for one thread alone
  std::size_t used_ = 0;                                        ///< units that are full
  GeometryReport report_;
};

}  // namespace farop
