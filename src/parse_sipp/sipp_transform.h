// SPDX-License-Identifier: GPL-3.0-or-later
// SIPP's transformations: each is applied after what the matrix does already.
//
// Row vectors (p' = p M), angles in radians, counter-clockwise seen from the positive end of the axis. A
// cosine or sine below 1e-15 in magnitude counts as 0, so that quarter turns are exact.
#pragma once

#include "core/math.h"

namespace farop::sipp {

void translate(M44d& matrix, const V3d& by);
/// The translation that is in the matrix already is scaled too.
void scale(M44d& matrix, const V3d& factors);
void rotate_x(M44d& matrix, double angle);
void rotate_y(M44d& matrix, double angle);
void rotate_z(M44d& matrix, double angle);
/// About the line through `point` along `direction`.
void rotate(M44d& matrix, const V3d& point, const V3d& direction, double angle);
/// In the plane through `point` across `normal`, which may have any length but zero (that leaves the matrix
/// as it is).
void mirror(M44d& matrix, const V3d& point, const V3d& normal);
/// matrix = matrix * by.
void transform(M44d& matrix, const M44d& by);

}  // namespace farop::sipp
