// SPDX-License-Identifier: GPL-3.0-or-later
// Which samples a polygon covers, exactly, under every fill rule that is consistent.
//
// A consistent rule is the limit of moving the sample by (+-a, +-b), a and b vanishing one faster than the
// other: a moved sample never lies on an edge, so polygons that tile the plane cover every sample once. There
// are eight. Inside is what parity says. All in integers.
//
// Independent of the rasterizers that it judges: nothing of src/raster is used.
#pragma once

#include <cstdint>
#include <span>

#include "conformance/drawing.h"

namespace farop::conformance {

/// By the sides whose edges belong to the polygon; the first letter decides at corners, or (with 2) the
/// second.
enum class ConsistentRule : std::uint8_t { lb, lt, rb, rt, lb2, lt2, rb2, rt2 };

constexpr std::uint8_t rule_bit(ConsistentRule rule) {
  return static_cast<std::uint8_t>(1u << static_cast<unsigned>(rule));
}

/// For every sample of the window a byte with rule_bit() of each rule that covers it: 0xFF inside, 0 outside,
/// anything on the boundary. Any coordinates of 32 bits. `subpixel_bits` B, 0..16: corners are in units of
/// 2^-B of the distance between samples, and sample (i, j) lies at (i 2^B, j 2^B).
Bitmap coverage_masks(std::span<const ScreenVertex> polygon, const Window& window, int subpixel_bits = 0);

/// Sets `value` where an edge passes exactly through a sample.
void mark_boundary(std::span<const ScreenVertex> polygon, Bitmap& bitmap, std::uint8_t value);

}  // namespace farop::conformance
