// SPDX-License-Identifier: GPL-3.0-or-later
// Line segments on whole pixels.
#pragma once

#include <array>
#include <cstdint>

#include "core/framebuffer.h"

namespace farop {

/// A pixel, in the frame or not. Coordinates fit 33 bits.
struct PixelPosition {
  std::int64_t x = 0, y = 0;
};

/// Draws from the lower end (of equal height: the left one) to the other, both ends included, so the order of
/// the ends does not matter. Where the exact line passes half-way between two pixels, the one farther from
/// the start is drawn, as in the source. Pixels outside the picture are left out without touching those
/// inside. Source: J. E. Bresenham, "Algorithm for computer control of a digital plotter", IBM Systems
/// Journal 4(1), 1965.
void draw_line(Framebuffer& picture, PixelPosition a, PixelPosition b,
               const std::array<std::uint8_t, 3>& color);

}  // namespace farop
