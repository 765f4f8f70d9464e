// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/run.h"

#include <tbb/info.h>

#include <algorithm>
#include <limits>

namespace farop {
namespace {

/// Corners that a batch of one thread alone has at least: long enough that a clock
/// reading per batch costs nothing, short enough to stay in the L2 cache.
constexpr std::size_t k_batch_corners = 4096;
/// Corners of a unit for one of several threads: long enough to be worth passing to another processor.
constexpr std::size_t k_unit_corners = 8192;
/// Units waiting at once, so that threads that are done early find another.
constexpr std::size_t k_units_per_thread = 4;
constexpr int k_most_threads = 1024;
/// Polygons between two calls of the progress function.
constexpr std::uint64_t k_progress_step = 1u << 14;

std::size_t thread_count(const GeometryOptions& options) {
  if (options.path == GeometryPath::plain) return 1;
  const int wanted = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  return static_cast<std::size_t>(std::clamp(wanted, 1, k_most_threads));
}

}  // namespace

GeometryRun::GeometryRun(const Scene& scene, const GeometrySetup& setup, const GeometryOptions& options,
                         ScreenPolygonSink& sink, GeometryClocks& clocks, const ProgressFunction& progress)
    : setup_(setup),
      sink_(sink),
      clocks_(clocks),
      progress_(progress),
      total_(progress ? totals(scene).polygons : 0),
      wants_(sink.wants()),
      threads_(thread_count(options)),
      world_to_eye_(world_to_eye(setup.camera)) {
  report_.degenerate_of_input.resize(scene.root.children.size());
  if (options.path == GeometryPath::plain) {
    plain_.emplace(setup, options, wants_);
  } else {
    for (std::size_t i = 0; i < threads_; ++i)
      stages_.push_back(std::make_unique<batched::BatchedStage>(setup, options, wants_));
  }
  if (threads_ > 1) workers_.emplace(static_cast<int>(threads_));
  units_.resize(threads_ == 1 ? 1 : threads_ * k_units_per_thread);
}

void GeometryRun::surface(const SurfacePlacement& placement) {
  const Surface& surface = placement.surface;
  // Expected ones are taken off, so that nobody is warned of them.
  report_.degenerate_of_input[placement.input] -= surface.cone_tip_triangles;
  surfaces_.emplace_back(placement, world_to_eye_, setup_.camera.from);
  batched::Piece rest{&surfaces_.back(), surface.polygons.begin(), surface.polygons.size()};
  if (threads_ == 1) {
    while (rest.polygons > 0) work_alone(rest);
    surfaces_.clear();
    return;
  }
  const bool pure = !surface.shader || surface.shader->is_pure();
  while (rest.polygons > 0) {
    Unit& unit = units_[used_];
    batched::Piece piece{rest.placed, rest.first, 0};
    for (; rest.polygons > 0 && unit.corners < k_unit_corners;
         ++rest.first, --rest.polygons, ++piece.polygons)
      unit.corners += (*rest.first).corners.size();
    unit.pieces.push_back(piece);
    unit.pure = unit.pure && pure;
    if (unit.corners >= k_unit_corners && ++used_ == units_.size()) work_together();
  }
}

GeometryReport GeometryRun::finish() {
  if (threads_ == 1) {
    hand_over(units_[0].batch);
    report_.counts = units_[0].counts;
  } else {
    used_ = std::min(used_ + 1, units_.size());
    work_together();
  }
  return std::move(report_);
}

void GeometryRun::work_on(batched::Piece& piece, std::size_t enough, Unit& unit, std::size_t worker) {
  if (!plain_) {
    stages_[worker]->run(piece, enough, unit.batch, unit.counts);
    return;
  }
  for (; piece.polygons > 0 && unit.batch.vertices.size() < enough; ++piece.first, --piece.polygons)
    plain_->polygon(*piece.placed, *piece.first, unit.batch, unit.counts);
}

void GeometryRun::work_alone(batched::Piece& piece) {
  Unit& unit = units_[0];
  const PolygonCounts before = unit.counts;
  batched::Piece next = piece;
  next.polygons = std::min(next.polygons, k_progress_step);
  const std::uint64_t given = next.polygons;
  work_on(next, k_batch_corners, unit, 0);
  piece.first = next.first;
  piece.polygons -= given - next.polygons;
  report_.degenerate_of_input[piece.placed->input] += unit.counts.degenerate - before.degenerate;
  if (unit.batch.vertices.size() >= k_batch_corners) hand_over(unit.batch);
  show_progress(before.loaded, unit.counts.loaded);
}

void GeometryRun::work_together() {
  constexpr std::size_t k_all = std::numeric_limits<std::size_t>::max();
  const auto work = [&](Unit& unit, std::size_t worker) {
    for (batched::Piece& piece : unit.pieces) {
      const std::uint64_t before = unit.counts.degenerate;
      work_on(piece, k_all, unit, worker);
      unit.degenerate.push_back(unit.counts.degenerate - before);
    }
  };
  for (std::size_t i = 0; i < used_; ++i) {
    if (!units_[i].pure) work(units_[i], 0);
  }
  workers_->run(used_, [&](std::size_t i, std::size_t worker) {
    if (units_[i].pure) work(units_[i], worker);
  });
  const std::uint64_t before = report_.counts.loaded;
  for (std::size_t i = 0; i < used_; ++i) {
    take_counts(units_[i]);
    hand_over(units_[i].batch);
  }
  used_ = 0;
  // The last surface may have polygons that come in the next unit.
  while (surfaces_.size() > 1) surfaces_.pop_front();
  show_progress(before, report_.counts.loaded);
}

void GeometryRun::show_progress(std::uint64_t before, std::uint64_t now) const {
  if (progress_ && before / k_progress_step != now / k_progress_step) progress_(now, total_);
}

void GeometryRun::take_counts(Unit& unit) {
  for (std::size_t i = 0; i < unit.pieces.size(); ++i)
    report_.degenerate_of_input[unit.pieces[i].placed->input] += unit.degenerate[i];
  report_.counts += unit.counts;
  unit.counts = {};
  unit.pieces.clear();
  unit.degenerate.clear();
  unit.corners = 0;
  unit.pure = true;
}

void GeometryRun::hand_over(ScreenPolygonBatch& batch) {
  if (batch.polygons.empty()) return;
  clocks_.geometry.stop();
  {
    const TimedSlice slice(clocks_.sink);
    sink_.polygons(batch);
  }
  clocks_.geometry.start();
  batch.clear();
}

}  // namespace farop
