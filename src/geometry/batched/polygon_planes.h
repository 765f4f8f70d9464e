// SPDX-License-Identifier: GPL-3.0-or-later
// Planes of the polygons of a chunk, and which side they show: all that culling asks for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"
#include "geometry/batched/kernels.h"

namespace farop::batched {

/// Sorts short polygons by their number of corners, so that those of one number are computed together.
class PolygonPlanes {
 public:
  struct Side {
    bool degenerate = false;
    bool faces_away = false;
  };

  void clear();
  /// The next polygon, of at least 3 corners.
  void add(std::span<const V3d> positions, std::span<const std::uint32_t> corners);
  /// Computes the planes of all polygons, as seen from `eye`.
  void find(const V3d& eye);
  // Of polygon i in the order they were added, after find(): what plane_normal() (scene/plane.h) and the
  // facing test say.
  Side side(std::size_t i) const {
    const PlaneGroup& group = groups_[places_[i] / k_lanes];
    const std::size_t lane = places_[i] % k_lanes;
    return {(group.degenerate >> lane & 1) != 0, (group.faces_away >> lane & 1) != 0};
  }
  /// Unit length, same space as the positions; meaningless where degenerate.
  V3d normal(std::size_t i) const {
    const PlaneGroup& group = groups_[places_[i] / k_lanes];
    const std::size_t lane = places_[i] % k_lanes;
    return {group.x[lane], group.y[lane], group.z[lane]};
  }

 private:
  /// Polygons of more corners are computed one by one.
  static constexpr std::size_t k_short = 12;

  std::uint32_t open_group(std::size_t corners, std::size_t rows);

  std::vector<PlaneGroup> groups_;
  std::vector<Row> rows_;              ///< where groups have their corners
  std::vector<std::uint32_t> places_;  ///< of polygons: group * k_lanes + lane
  /// By number of corners: the place for the next polygon; full at a multiple of k_lanes.
  std::array<std::uint32_t, k_short + 1> open_{};
};

}  // namespace farop::batched
