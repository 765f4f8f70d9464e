// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors, matrices and the one rounding rule.
//
// Imath multiplies row vectors from the left, so a chain of transformations reads left to right:
// point * local_to_world * world_to_eye.
#pragma once

#include <ImathMatrix.h>
#include <ImathVec.h>

#include <cmath>

namespace farop {

using V2d = Imath::V2d;
using V3d = Imath::V3d;
using V3f = Imath::V3f;
using M44d = Imath::M44d;

/// Nearest integer, halves upwards: floor(v + 0.5). The rule for device coordinates, depths and colours alike
/// (unlike std::round, which turns halves away from zero).
inline double round_half_up(double v) {
  return std::floor(v + 0.5);
}

}  // namespace farop
