// SPDX-License-Identifier: GPL-3.0-or-later
// What the picture of one polygon must be, straight from the definitions, without regard to speed.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/screen_polygon.h"
#include "raster/wide_integer.h"

namespace farop::reference {

/// Fill rule `lb`: an odd number of non-horizontal edges e with ymin(e) <= row < ymax(e) and x_e(row) <=
/// column. Any coordinates; columns and rows count samples, vertices are in units of 1 / 2^subpixel_bits
/// sample.
bool covers(std::span<const ScreenVertex> corners, int subpixel_bits, std::int64_t column, std::int64_t row);

/// covers() for every sample of a frame, row by row from the bottom: 1 or 0.
std::vector<std::uint8_t> coverage(std::span<const ScreenVertex> corners, int subpixel_bits, int width,
                                   int height);

/// A value without rounding; denominator > 0.
struct Rational {
  Int128 numerator = 0, denominator = 1;

  /// |value - this| < bound.
  bool is_within(std::int64_t value, std::int64_t bound) const;
};

/// The affine function a(x, y) that takes given integer values at the corners of a polygon: depth or colour
/// of a triangle, or of an n-gon that is planar on the lattice. Numbers: |values| <= 2^31; with any int32
/// coordinates numerators stay below 2^101.
class AffineFunction {
 public:
  /// `values` runs parallel to `corners`. Nothing when all corners lie on one line, or no affine function
  /// fits.
  static std::optional<AffineFunction> through(std::span<const ScreenVertex> corners,
                                               std::span<const std::int64_t> values);
  Rational at(int subpixel_bits, std::int64_t column, std::int64_t row) const;

 private:
  Rational at_point(std::int64_t x, std::int64_t y) const;

  // a(x, y) = (a0_ c_ + a_ (x - x0_) + b_ (y - y0_)) / c_, c_ > 0
  std::int64_t x0_ = 0, y0_ = 0, a0_ = 0;
  Int128 a_ = 0, b_ = 0, c_ = 0;
};

}  // namespace farop::reference
