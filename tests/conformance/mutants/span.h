// SPDX-License-Identifier: GPL-3.0-or-later
// Edges, and what lies between two of them on a row: crossings, depth and colour as exact fractions (Gouraud,
// IEEE Transactions on Computers C-20(6), 1971).
#pragma once

#include "canvas.h"
#include "ramp.h"

enum Attribute { k_z, k_red, k_green, k_blue, k_attributes };

inline int attribute_of(const farop_vertex& v, int attribute) {
  const int values[k_attributes] = {v.z, v.r, v.g, v.b};
  return values[attribute];
}

/// Not horizontal. Crosses the rows first_row .. end_row - 1.
struct Edge {
  farop_vertex low, high;
  int first_row, end_row;

  int dx() const { return high.x - low.x; }
  int dy() const { return high.y - low.y; }
};

/// Where an edge crosses a row. Everything here is times dy.
struct Crossing {
  std::int64_t x, dy, value[k_attributes];
};

inline Crossing cross(const Edge& e, int row) {
  Crossing c{};
  const std::int64_t up = row - e.low.y;
  c.dy = e.dy();
  c.x = e.low.x * c.dy + up * e.dx();
  for (int a = 0; a < k_attributes; ++a) {
    const std::int64_t low = attribute_of(e.low, a), high = attribute_of(e.high, a);
    c.value[a] = low * c.dy + up * (high - low);
    // 62: takes the colours of the corners nearest to the row and skips the interpolation along the edges.
    if (k_mutant == 62 && a != k_z) c.value[a] = (2 * up < c.dy ? low : high) * c.dy;
  }
  return c;
}

/// Depth and colour at the samples of a row, from left to right.
class Shade {
 public:
  Shade(const Crossing& left, const Crossing& right, const farop_vertex& first_corner, int column)
      : from_left_(column * left.dy - left.x), width_(right.x * left.dy - left.x * right.dy) {
    for (int a = 0; a < k_attributes; ++a) ramp_[a] = ramp(a, left, right, first_corner);
    if constexpr (k_mutant == 48) start_24_4(left, right);
    if constexpr (k_mutant == 58) start_float(left, right);
    if constexpr (k_mutant == 60) start_8_bit(left, right);
  }

  int z() const { return k_mutant == 48 ? z_24_4_ >> 4 : ramp_[k_z].value(); }
  Rgb color() const {
    const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
    if constexpr (k_mutant == 58) return {weighted(0), weighted(1), weighted(2)};
    if constexpr (k_mutant == 60) return {wrapped(0), wrapped(1), wrapped(2)};
    return {byte(ramp_[k_red].value()), byte(ramp_[k_green].value()), byte(ramp_[k_blue].value())};
  }
  void next() {
    for (Ramp& ramp : ramp_) ramp.next();
    if constexpr (k_mutant == 48) z_24_4_ += z_step_24_4_;
    if constexpr (k_mutant == 58) weight_ += weight_step_;
    if constexpr (k_mutant == 60) t_.next();
  }
  void next_z() { ramp_[k_z].next(); }

 private:
  // At column i: left + (right - left) (i - x_left) / (x_right - x_left), with everything over left.dy width.
  Ramp ramp(int a, const Crossing& left, const Crossing& right, const farop_vertex& first_corner) const {
    const bool is_color = a != k_z;
    // 50, 57: reads the value of the polygon's first corner for every pixel (flat shading).
    if (k_mutant == (is_color ? 57 : 50)) return {attribute_of(first_corner, a), 0, 1};
    if (width_ == 0) return {left.value[a], 0, left.dy};
    // 46, 59: the first pixel gets the value of the crossing, which lies up to a pixel further left.
    const std::int64_t from_left = k_mutant == (is_color ? 59 : 46) ? 0 : from_left_;
    const Int128 difference = change(a, left, right);
    Int128 step = difference * left.dy;
    // 61: a copied line; green goes on with the step of red.
    if (k_mutant == 61 && a == k_green) step = change(k_red, left, right) * left.dy;
    return {Int128{left.value[a]} * width_ + difference * from_left, step, left.dy * width_};
  }

  static Int128 change(int a, const Crossing& left, const Crossing& right) {
    const Int128 exact = Int128{right.value[a]} * left.dy - Int128{left.value[a]} * right.dy;
    // 49: int * int is int, whatever it is assigned to.
    if (k_mutant == 49 && a == k_z) {
      const auto low = [](std::int64_t value) { return static_cast<std::uint32_t>(value); };
      return static_cast<std::int32_t>(low(right.value[a]) * low(left.dy) -
                                       low(left.value[a]) * low(right.dy));
    }
    return exact;
  }

  // 48: depth in 24.4 fixed point: the step is cut to sixteenths and the error added up along the span.
  void start_24_4(const Crossing& left, const Crossing& right) {
    if (width_ == 0) {
      z_24_4_ = static_cast<int>(16 * left.value[k_z] / left.dy);
      return;
    }
    const Int128 difference = change(k_z, left, right);
    const Int128 start = Int128{left.value[k_z]} * width_ + difference * from_left_;
    z_24_4_ = static_cast<int>(16 * start / (Int128{left.dy} * width_));
    z_step_24_4_ = static_cast<int>(16 * difference / width_);
  }

  // 58: colours as sums of float weights that add up to a little less than 1, cut to int.
  void start_float(const Crossing& left, const Crossing& right) {
    const auto ratio = [](std::int64_t p, std::int64_t q) {
      return static_cast<float>(p) / static_cast<float>(q);
    };
    weight_ = width_ == 0 ? 0 : ratio(from_left_, 1) * ratio(right.dy, width_);
    weight_step_ = width_ == 0 ? 0 : ratio(left.dy, 1) * ratio(right.dy, width_);
    for (int a = 0; a < 3; ++a) {
      left_color_[a] = ratio(left.value[a + 1], left.dy);
      right_color_[a] = ratio(right.value[a + 1], right.dy);
    }
  }
  std::uint8_t weighted(int a) const {
    const float w = weight_ < 0 ? 0 : weight_ > 1 ? 1 : weight_;
    return static_cast<std::uint8_t>(left_color_[a] * (1 - w) + right_color_[a] * w);
  }

  // 60: the difference of two colours in a byte: where the colour falls, it is 256 too large, and the sum
  // wraps.
  void start_8_bit(const Crossing& left, const Crossing& right) {
    const auto rounded = [](const Crossing& c, int a) { return floor_div(2 * c.value[a] + c.dy, 2 * c.dy); };
    if (width_ > 0) t_ = Ramp(Int128{256} * from_left_ * right.dy, Int128{256} * left.dy * right.dy, width_);
    for (int a = 0; a < 3; ++a) {
      base_[a] = static_cast<std::uint8_t>(rounded(left, a + 1));
      byte_change_[a] = static_cast<std::uint8_t>(rounded(right, a + 1) - base_[a]);
    }
  }
  std::uint8_t wrapped(int a) const {
    return static_cast<std::uint8_t>(base_[a] + ((byte_change_[a] * t_.value() + 128) >> 8));
  }

  std::int64_t from_left_;  ///< from the left crossing to the column, times left.dy
  std::int64_t width_;      ///< from crossing to crossing, times left.dy right.dy
  Ramp ramp_[k_attributes];
  int z_24_4_ = 0, z_step_24_4_ = 0;
  float weight_ = 0, weight_step_ = 0, left_color_[3] = {}, right_color_[3] = {};
  Ramp t_;
  std::uint8_t base_[3] = {}, byte_change_[3] = {};
};
