// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/reference.h"

#include <utility>

namespace farop::reference {

bool covers(std::span<const ScreenVertex> corners, int subpixel_bits, std::int64_t column, std::int64_t row) {
  const std::int64_t x = column << subpixel_bits, y = row << subpixel_bits;
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ScreenVertex* low = &corners[i];
    const ScreenVertex* high = &corners[i + 1 < corners.size() ? i + 1 : 0];
    if (low->y > high->y) std::swap(low, high);
    if (y < low->y || y >= high->y) continue;
    const std::int64_t dx = std::int64_t{high->x} - low->x, dy = std::int64_t{high->y} - low->y;
    if (Int128{x - low->x} * dy - Int128{y - low->y} * dx >= 0) inside = !inside;
  }
  return inside;
}

std::vector<std::uint8_t> coverage(std::span<const ScreenVertex> corners, int subpixel_bits, int width,
                                   int height) {
  std::vector<std::uint8_t> covered;
  covered.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      covered.push_back(covers(corners, subpixel_bits, column, row) ? 1 : 0);
    }
  }
  return covered;
}

bool Rational::is_within(std::int64_t value, std::int64_t bound) const {
  const Int128 difference = Int128{value} * denominator - numerator;
  return (difference < 0 ? -difference : difference) < Int128{bound} * denominator;
}

std::optional<AffineFunction> AffineFunction::through(std::span<const ScreenVertex> corners,
                                                      std::span<const std::int64_t> values) {
  if (corners.empty()) return std::nullopt;
  AffineFunction f;
  f.x0_ = corners[0].x, f.y0_ = corners[0].y, f.a0_ = values[0];
  // The first corner, another one, and a third off their line.
  std::size_t p = 0;
  while (p < corners.size() && corners[p].x == f.x0_ && corners[p].y == f.y0_) ++p;
  for (std::size_t q = p + 1; q < corners.size() && f.c_ == 0; ++q) {
    const Int128 px = corners[p].x - f.x0_, py = corners[p].y - f.y0_, pa = values[p] - f.a0_;
    const Int128 qx = corners[q].x - f.x0_, qy = corners[q].y - f.y0_, qa = values[q] - f.a0_;
    f.a_ = pa * qy - qa * py, f.b_ = px * qa - qx * pa, f.c_ = px * qy - qx * py;
  }
  if (f.c_ == 0) return std::nullopt;
  if (f.c_ < 0) f.a_ = -f.a_, f.b_ = -f.b_, f.c_ = -f.c_;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Rational here = f.at_point(corners[i].x, corners[i].y);
    if (here.numerator != Int128{values[i]} * here.denominator) return std::nullopt;
  }
  return f;
}

Rational AffineFunction::at(int subpixel_bits, std::int64_t column, std::int64_t row) const {
  return at_point(column << subpixel_bits, row << subpixel_bits);
}

Rational AffineFunction::at_point(std::int64_t x, std::int64_t y) const {
  return {a0_ * c_ + a_ * (x - x0_) + b_ * (y - y0_), c_};
}

}  // namespace farop::reference
