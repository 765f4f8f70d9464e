// SPDX-License-Identifier: GPL-3.0-or-later
// Interpolation by scan lines: along the edges that bound a span, then along the span. The one definition for
// the plain path and the fast one.
#pragma once

#include "raster/edge_table.h"

namespace farop {

/// An attribute along a span, `distance` columns from its left crossing.
template <class T>
struct Ramp {
  Ramp(const T& left, const T& right, double width) : start(left), slope((right - left) * (1 / width)) {}
  T at(double distance) const { return start + slope * distance; }

  T start, slope;
};

/// What an edge has at a point, of what it has at its ends.
template <class T>
T mix(const EdgePoint& point, const T& bottom, const T& top) {
  return bottom + (top - bottom) * point.along;
}

/// Depths are at least 0, so that truncation rounds to nearest.
inline Ramp<double> depth_ramp(double left, double right, double width) {
  return {left + 0.5, right + 0.5, width};
}

}  // namespace farop
