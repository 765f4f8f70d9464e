// SPDX-License-Identifier: GPL-3.0-or-later
// Exact geometric predicates on points of the plane.
//
// Answers are those of real arithmetic on the doubles as given, never of rounded arithmetic. Coordinates must
// be finite. x grows to the right, y upwards; units do not matter.
// Source:    CGAL's filtered kernel; the idea is Shewchuk, "Adaptive Precision Floating-Point Arithmetic and
//            Fast Robust Geometric Predicates", Discrete & Computational Geometry 18, 1997.
#pragma once

#include <span>

#include "core/math.h"

namespace farop {

/// Which way the path a, b, c turns: 1 to the left (counter-clockwise), -1 to the right, 0 when the three
/// are collinear or two of them coincide.
int orientation(const V2d& a, const V2d& b, const V2d& c);

/// Sign of the area that a closed ring encloses: 1 counter-clockwise, -1 clockwise, 0 without area.
int area_sign(std::span<const V2d> ring);

}  // namespace farop
