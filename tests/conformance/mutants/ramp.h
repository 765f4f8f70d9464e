// SPDX-License-Identifier: GPL-3.0-or-later
// A value that changes linearly from sample to sample, exact at every one.
#pragma once

#include <cstdint>

__extension__ using Int128 = __int128;

inline std::int64_t floor_div(Int128 p, Int128 q) {  // q > 0
  return static_cast<std::int64_t>(p / q - (p % q < 0 ? 1 : 0));
}
inline std::int64_t ceil_div(Int128 p, Int128 q) {
  return -floor_div(-p, q);
}

/// (start + k step) / denominator for k = 0, 1, 2, ..., rounded to nearest. denominator > 0 and below 2^61;
/// start and step below 2^100; values below 2^31. Whole part and rest are stepped apart, so nothing is ever
/// rounded twice.
class Ramp {
 public:
  Ramp() = default;
  Ramp(Int128 start, Int128 step, std::int64_t denominator)
      : denominator_(2 * denominator),
        value_(floor_div(2 * start + denominator, denominator_)),
        rest_(static_cast<std::int64_t>(2 * start + denominator - Int128{value_} * denominator_)) {
    if (step == 0) return;  // most are flat, and dividing takes long
    step_ = floor_div(2 * step, denominator_);
    step_rest_ = static_cast<std::int64_t>(2 * step - Int128{step_} * denominator_);
  }
  int value() const { return static_cast<int>(value_); }
  void next() {
    value_ += step_;
    rest_ += step_rest_;
    if (rest_ >= denominator_) rest_ -= denominator_, ++value_;
  }

 private:
  std::int64_t denominator_ = 1, value_ = 0, rest_ = 0, step_ = 0, step_rest_ = 0;
};
