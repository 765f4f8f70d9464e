// SPDX-License-Identifier: GPL-3.0-or-later
// M. Newell's teapot (1975): 28 bicubic Bezier patches, and the four of the bottom that was added later.
#pragma once

#include <array>
#include <cstdint>

#include "core/math.h"

namespace farop {

/// Control nets of bicubic Bezier patches: indices into k_teapot_points, net row by row.
extern const std::array<std::array<std::uint16_t, 16>, 32> k_teapot_patches;
extern const std::array<V3d, 290> k_teapot_points;

}  // namespace farop
