// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/color.h"
#include "core/math.h"

namespace farop {

/// A corner's colour component 0..resolution-1 as 8 bits, rounded to nearest; larger ones are limited.
inline std::uint8_t to_8_bits(std::uint16_t component, int resolution) {
  if (resolution == 256) return static_cast<std::uint8_t>(std::min<std::uint16_t>(component, 255));
  return static_cast<std::uint8_t>(std::min(round_half_up(255.0 * component / (resolution - 1)), 255.0));
}

inline V3d to_vector(const Rgb& c) {
  return {c.r, c.g, c.b};
}

}  // namespace farop
