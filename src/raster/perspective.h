// SPDX-License-Identifier: GPL-3.0-or-later
// Interpolation in perspective of what shaders ask for: patterns would slide over their surfaces otherwise.
#pragma once

#include "core/math.h"

namespace farop {

/// What a shader asks of a point beside its normal: the place in eye space, and texture coordinates.
struct Place {
  V3d position{0, 0, 0}, texture{0, 0, 0};
};

/// x/z, y/z, 1/z and the texture coordinates divided by z are linear on the screen where x, y, z and the
/// texture coordinates are linear in space; the same function takes them back. z > 0: in front of the eye.
inline Place projected(const Place& p) {
  const V3d position{p.position.x / p.position.z, p.position.y / p.position.z, 1 / p.position.z};
  return {position, p.texture * position.z};
}

}  // namespace farop
