// SPDX-License-Identifier: GPL-3.0-or-later
// Depth and colour of a polygon as exact rational functions of the sample, and how far a correct rasterizer
// may be off.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "conformance/drawing.h"
#include "conformance/wide.h"

namespace farop::conformance {

enum class Attribute : std::uint8_t { z, r, g, b };
inline constexpr std::array k_attributes = {Attribute::z, Attribute::r, Attribute::g, Attribute::b};
inline constexpr std::array k_channels = {Attribute::r, Attribute::g, Attribute::b};

std::int64_t value_of(const ScreenVertex& v, Attribute attribute);
void set_value(ScreenVertex& v, Attribute attribute, std::int64_t value);

/// numerator / denominator, denominator > 0; not reduced.
struct Rational {
  Wide numerator = 0, denominator = 1;

  double value() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }
  Wide floor() const { return floor_quotient(numerator, denominator); }
  Wide ceil() const { return ceil_quotient(numerator, denominator); }
  friend Rational operator+(const Rational& a, const Rational& b) {
    return {a.numerator * b.denominator + b.numerator * a.denominator, a.denominator * b.denominator};
  }
  friend Rational operator-(const Rational& a, const Rational& b) {
    return {a.numerator * b.denominator - b.numerator * a.denominator, a.denominator * b.denominator};
  }
  friend bool operator<(const Rational& a, const Rational& b) {
    return a.numerator * b.denominator < b.numerator * a.denominator;
  }
  friend bool operator<=(const Rational& a, const Rational& b) { return !(b < a); }
  friend bool operator==(const Rational& a, const Rational& b) {
    return a.numerator * b.denominator == b.numerator * a.denominator;
  }
};
Rational absolute(const Rational& a);

/// (a x + b y + c) / d, d > 0.
struct Plane {
  Wide a = 0, b = 0, c = 0, d = 1;

  Rational at(std::int64_t x, std::int64_t y) const { return {a * x + b * y + c, d}; }
  bool constant() const { return a == 0 && b == 0; }
};

/// The plane through all corners; nothing when they are not on one (more than three corners), or all of them
/// lie on a line of the screen with different values. Exact for coordinates below 2^16 and values below 2^31.
std::optional<Plane> plane_through(std::span<const ScreenVertex> polygon, Attribute attribute);

/// How far a correct value may be from the exact one. Any rounding stays below 1; what stepping with 16
/// fractional bits adds is counted step by step: rows, columns, and twice the slope for a crossing that is
/// known to a 65536th only.
struct Tolerance {
  Rational unremarkable;  ///< T1: there is nothing to say
  Rational bound;         ///< T2: beyond it the value is wrong; between the two: drift
};
Tolerance tolerance_of(std::span<const ScreenVertex> polygon, const Plane& plane);

/// What the scan-line method gives: along the two active edges to the row, then along the span. Nothing where
/// the sample is outside the polygon's spans. For any simple polygon.
std::optional<Rational> scan_line_value(std::span<const ScreenVertex> polygon, Attribute attribute, int x,
                                        int y);

}  // namespace farop::conformance
