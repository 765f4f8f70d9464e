// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/run.h"

#include <algorithm>

namespace farop {
namespace {

/// Corners that one thread alone takes at once, and that a batch has at least: long enough that a clock
/// reading per batch costs nothing, short enough to stay in the L2 cache.
constexpr std::size_t k_batch_corners = 4096;
/// Corners of a unit for one of several threads: long enough to be worth passing to another processor.
constexpr std::size_t k_unit_corners = 8192;
/// Units waiting at once, so that threads that are done early find another.
constexpr std::size_t k_units_per_thread = 4;
constexpr int k_most_threads = 1024;
/// Polygons between two calls of the progress function.
constexpr std::uint64_t k_progress_step = 1u << 14;

PolygonCounts& operator+=(PolygonCounts& sum, const PolygonCounts& c) {
  sum.loaded += c.loaded;
  sum.back_facing += c.back_facing;
  sum.degenerate += c.degenerate;
  sum.totally_clipped += c.totally_clipped;
  sum.rendered += c.rendered;
  sum.partly_clipped += c.partly_clipped;
  sum.split_to_triangles += c.split_to_triangles;
  sum.triangles += c.triangles;
  sum.vertices += c.vertices;
  return sum;
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
      threads_(static_cast<std::size_t>(std::clamp(options.threads, 1, k_most_threads))),
      world_to_eye_(world_to_eye(setup.camera)) {
  report_.degenerate_of_input.resize(scene.root.children.size());
  if (options.path == GeometryPath::plain) {
    threads_ = 1;
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
  const bool pure = !surface.shader || surface.shader->is_pure();
  const std::size_t full = threads_ == 1 ? k_batch_corners : k_unit_corners;
  PolygonList::Iterator at = surface.polygons.begin();
  for (std::uint64_t left = surface.polygons.size(); left > 0;) {
    Unit& unit = units_[used_];
    batched::Piece piece{&surfaces_.back(), at, 0};
    for (; left > 0 && unit.corners < full; ++at, --left, ++piece.polygons)
      unit.corners += (*at).corners.size();
    unit.pieces.push_back(piece);
    unit.pure = unit.pure && pure;
    if (unit.corners >= full && ++used_ == units_.size()) work(false);
  }
}

GeometryReport GeometryRun::finish() {
  used_ = std::min(used_ + 1, units_.size());
  work(true);
  return std::move(report_);
}

void GeometryRun::work(bool last) {
  const std::uint64_t ticks = report_.counts.loaded / k_progress_step;
  const auto minds = [this](const Unit& unit) { return threads_ == 1 || !unit.pure; };
  for (std::size_t i = 0; i < used_; ++i) {
    if (minds(units_[i])) work_on(units_[i], 0);
  }
  if (threads_ > 1) {
    workers_->run(used_, [&](std::size_t i, std::size_t worker) {
      if (!minds(units_[i])) work_on(units_[i], worker);
    });
  }
  for (std::size_t i = 0; i < used_; ++i) {
    Unit& unit = units_[i];
    take_counts(unit);
    // One thread alone collects until it is worth it.
    if (last || threads_ > 1 || unit.batch.vertices.size() >= k_batch_corners) hand_over(unit.batch);
  }
  used_ = 0;
  // The last surface may have polygons that come in the next unit.
  while (surfaces_.size() > 1) surfaces_.pop_front();
  if (progress_ && report_.counts.loaded / k_progress_step != ticks) progress_(report_.counts.loaded, total_);
}

void GeometryRun::work_on(Unit& unit, std::size_t worker) {
  for (const batched::Piece& piece : unit.pieces) {
    const std::uint64_t before = unit.counts.degenerate;
    if (plain_) {
      PolygonList::Iterator at = piece.first;
      for (std::uint64_t i = 0; i < piece.polygons; ++i, ++at)
        plain_->polygon(*piece.placed, *at, unit.batch, unit.counts);
    } else {
      stages_[worker]->run(piece, unit.batch, unit.counts);
    }
    unit.degenerate.push_back(unit.counts.degenerate - before);
  }
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
