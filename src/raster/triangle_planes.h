// SPDX-License-Identifier: GPL-3.0-or-later
// Depth and colour of a triangle as planes over the screen: the one definition of what is interpolated, for
// the plain path and the fast one.
//
// Numbers:  fixed point with 24 fraction bits, modulo 2^64 (depth) and 2^32 (colour). Sums modulo a power of
//           two do not depend on the order they are made in, so any blocking and any vector width gives the
//           same samples. Gradients are quotients of exact integers in double, rounded to nearest even: they
//           depend on the corners alone, not on their order. Do not contract into fused multiply-adds.
// Errors:   a plane triangle (is_plane_triangle()) keeps depths and colours within 2^-10 of the exact plane
//           before they are rounded, so they never leave the range of the corners.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/math.h"
#include "core/screen_polygon.h"

namespace farop {

constexpr int k_plane_fraction_bits = 24;
/// What rounds to nearest when fraction bits are cut off.
constexpr std::int64_t k_plane_half = std::int64_t{1} << (k_plane_fraction_bits - 1);
/// Of plane triangles: coordinates -2^23 .. 2^23, at most 2^13 pixels from corner to corner in x and in y.
constexpr int k_plane_coordinate_bits = 23;
constexpr int k_plane_extent_bits = 13;
/// Depth grows by at most 2^25 a pixel: an 8 x 8 block that a triangle meets stays within 32 bits.
constexpr int k_plane_gradient_bits = 25;

/// Corners a, b, c counter-clockwise; a is the lowest, of two the left one.
struct Triangle {
  ScreenVertex a, b, c;
};

/// Double of the area, in squared vertex units; > 0 counter-clockwise. Coordinates below 2^30.
inline std::int64_t doubled_area(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) {
  return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
         (std::int64_t{c.x} - a.x) * (std::int64_t{b.y} - a.y);
}

/// The corner that sees all of the polygon, if that is the lowest one (of equals the leftmost): the polygon
/// is the fan of triangles from it, without overlap. Every convex polygon is one, some concave ones are.
/// Nothing: no such fan, or coordinates beyond what frames can have (2^27).
std::optional<std::uint32_t> fan_center(std::span<const ScreenVertex> corners);

/// Corner numbers of the triangle that a fan has at its edge i -> i + 1, 0 < i < n - 1, counted from the
/// center; counter-clockwise. Nothing where it has no area.
std::optional<std::array<std::uint32_t, 3>> fan_triangle(std::span<const ScreenVertex> corners,
                                                         std::uint32_t center, std::uint32_t i);

/// is_plane_triangle() of nearly all triangles, quickly; false leaves it open. Coordinates are those of plane
/// triangles; `extent`: the larger of the lengths in x and y.
inline bool is_surely_plane_triangle(std::int32_t z1, std::int32_t z2, std::int32_t z3, std::int64_t extent,
                                     std::int64_t area, int subpixel_bits) {
  if (static_cast<std::uint32_t>(z1 | z2 | z3) >= 1u << 30) return false;
  const std::int64_t range = std::max(std::max(z1, z2), z3) - std::min(std::min(z1, z2), z3);
  return extent <= std::int64_t{1} << (k_plane_extent_bits + subpixel_bits) &&
         extent << subpixel_bits <= area << 17 &&
         ((2 * range * extent) << subpixel_bits) >> k_plane_gradient_bits < area;
}

/// Whether planes can be used (see Errors above). Otherwise, as for polygons without a fan, values are
/// interpolated along edges and spans. `t` has an area. The same for every order of the corners.
bool is_plane_triangle(const Triangle& t, int subpixel_bits);

/// Values at (x, y), the pixel's column and row in the frame.
class TrianglePlanes {
 public:
  /// `t` is a plane triangle; colours 0..255.
  TrianglePlanes(const Triangle& t, int subpixel_bits);

  std::int32_t depth(int x, int y) const {
    return static_cast<std::int32_t>(depth_.at(x, y) >> k_plane_fraction_bits);
  }
  /// 0..255 per channel, a multiple of 2^-16: exact as float, and to_byte() of it is exactly rounded.
  V3f color(int x, int y) const { return {channel(0, x, y), channel(1, x, y), channel(2, x, y)}; }

 private:
  struct Plane {
    std::uint64_t start = 0, step_x = 0, step_y = 0;

    std::uint64_t at(int x, int y) const {
      return start + static_cast<std::uint64_t>(x) * step_x + static_cast<std::uint64_t>(y) * step_y;
    }
  };

  float channel(std::size_t c, int x, int y) const {
    const auto value = static_cast<std::uint32_t>(color_[c].at(x, y));
    return static_cast<float>(static_cast<std::int32_t>(value >> 8) - (1 << 15)) * (1.0F / 65536);
  }

  Plane depth_;
  std::array<Plane, 3> color_;
};

/// Where a sample lies in a triangle: value = a + (b - a) * to_b + (c - a) * to_c.
struct Barycentric {
  Barycentric(const Triangle& t, int subpixel_bits, int x, int y);

  template <class T>
  T mix(const T& a, const T& b, const T& c) const {
    return a + (b - a) * to_b + (c - a) * to_c;
  }

  double to_b, to_c;
};

}  // namespace farop
