// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math.h"

namespace farop::nff {

/// A corner farther than this fraction of the polygon's diagonal from its plane is worth a warning; six
/// printed digits bend polygons far less.
constexpr double k_planarity_tolerance = 1e-3;

/// Watches the corners of one polygon go by: how far is the farthest from the plane of the first three,
/// compared with the diagonal of the polygon's axis-parallel box? Nothing is stored but sums, so polygons may
/// be of any size.
class PlanarityCheck {
 public:
  void add(const V3d& corner) {
    if (count_ == 0) first_ = corner;
    if (count_ == 1) second_ = corner;
    if (count_ == 2) normal_ = (second_ - first_).cross(corner - second_);
    if (count_ > 2) deviation_ = std::max(deviation_, std::abs((corner - first_).dot(normal_)));
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], corner[axis]);
      high_[axis] = std::max(high_[axis], corner[axis]);
    }
    ++count_;
  }

  /// Largest distance to the plane as a fraction of the diagonal; 0 where the first three corners give no
  /// plane or coordinates are too extreme to tell.
  double deviation() const {
    const double scale = (high_ - low_).length() * normal_.length();
    const double fraction = deviation_ / scale;
    return scale > 0 && std::isfinite(fraction) ? fraction : 0;
  }

 private:
  static constexpr double k_infinity = std::numeric_limits<double>::infinity();

  std::size_t count_ = 0;
  V3d first_{0, 0, 0}, second_{0, 0, 0}, normal_{0, 0, 0};
  V3d low_{k_infinity, k_infinity, k_infinity}, high_{-k_infinity, -k_infinity, -k_infinity};
  double deviation_ = 0;  ///< times the length of normal_
};

}  // namespace farop::nff
