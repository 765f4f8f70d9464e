// SPDX-License-Identifier: GPL-3.0-or-later
// Linear colours, no gamma anywhere.
#pragma once

namespace farop {

/// Red, green, blue; 0..1 unless a scene says otherwise (values outside are kept as read and clamped at
/// output).
struct Rgb {
  double r = 0, g = 0, b = 0;

  friend bool operator==(const Rgb&, const Rgb&) = default;
  friend Rgb operator*(const Rgb& c, double s) { return {c.r * s, c.g * s, c.b * s}; }
  friend Rgb operator*(const Rgb& c, const Rgb& o) { return {c.r * o.r, c.g * o.g, c.b * o.b}; }
  friend Rgb operator+(const Rgb& c, const Rgb& o) { return {c.r + o.r, c.g + o.g, c.b + o.b}; }
  Rgb& operator+=(const Rgb& o) { return *this = *this + o; }
};

/// Every channel limited to [0,1]; one that is no number becomes 0.
Rgb clamp01(const Rgb& c);

}  // namespace farop
