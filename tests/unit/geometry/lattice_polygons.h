// SPDX-License-Identifier: GPL-3.0-or-later
// Random polygons on the integer lattice, and exact checks of their triangulations. Coordinates below 2^20
// in size keep every product of the checks in 64 bits.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/math.h"

namespace farop::lattice {

struct Point {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};
using Polygon = std::vector<Point>;
using Triangle = std::array<std::uint32_t, 3>;
using Random = std::mt19937_64;

/// Uniform in 0 .. bound - 1. (The standard distributions differ between libraries.)
inline std::int64_t below(Random& random, std::int64_t bound) {
  return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(bound));
}

/// Twice the signed area of a, b, c; of a ring.
std::int64_t doubled_area(const Point& a, const Point& b, const Point& c);
std::int64_t doubled_area(const Polygon& ring);

/// Simple, counter-clockwise, up to `corners` corners in [0, size)^2; no two edges touch but at shared
/// corners. Corners with straight angles occur.
Polygon random_simple(Random& random, int corners, std::int64_t size);

/// Weakly simple, counter-clockwise, grown triangle by triangle so that on a small lattice it touches
/// itself at corners and along edges and closes around holes; with antennas some parts hang together by
/// lines without width only.
Polygon random_weakly_simple(Random& random, int corners, std::int64_t size, bool antennas);

/// Sutherland-Hodgman clipping of a polygon against one axis-parallel half-plane: keeps coordinate `axis`
/// (0 x, 1 y) at least, or at most, `limit`. The caller sees to it that all intersections are lattice
/// points; asserts otherwise.
Polygon clip(const Polygon& polygon, int axis, std::int64_t limit, bool keep_above);
/// A polygon scaled so that clip() at any lattice line of it meets lattice points, if it lies in [0, 13)^2.
constexpr std::int64_t k_clip_scale = 27720;  // least common multiple of 1..12
Polygon scaled(const Polygon& polygon, std::int64_t factor);

/// Adds what encloses nothing: repeated corners, corners inside edges, edges walked to and fro.
Polygon with_needles(Random& random, const Polygon& polygon, int count);

/// Says what is wrong with a triangulation, or nothing: n - 2 triangles over the ring's own edges and
/// diagonals, each ring edge used once and each diagonal twice, no negative area, areas adding up, no
/// overlap.
std::string fault(const Polygon& ring, const std::vector<Triangle>& triangles);

/// In the plane z = 0.
std::vector<V3d> to_space(const Polygon& polygon);
std::string to_string(const Polygon& polygon);

}  // namespace farop::lattice
