// SPDX-License-Identifier: GPL-3.0-or-later
// The calculations of the geometry stage for arrays of points, with vectors of whatever width the processor
// has (Highway; chosen at run time). Every result has the bits that the plain path computes: the same
// operations in the same order, nothing fused, square roots and divisions exact.
//
// Arrays are structure of arrays, one for each coordinate, aligned to k_alignment bytes; a kernel asked for n
// values reads and writes up to the next multiple of k_lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/color.h"
#include "core/math.h"
#include "geometry/clip.h"
#include "geometry/viewport.h"

namespace farop::batched {

/// The most values that any processor takes at once.
constexpr std::size_t k_lanes = 8;
constexpr std::size_t k_alignment = 64;

struct PointArrays {
  double *x, *y, *z;
};

// ------------------------------------------------------------------------------------------------ planes

struct alignas(k_alignment) Row {
  double values[k_lanes];
};

/// k_lanes polygons of equally many corners, lane by lane, three rows a corner: x, y, z. Or (is_long) a
/// single one, in lane 0: rows_of_long() rows of x, as many of y and of z, what is left of them filled with
/// the first corner. Lanes without a polygon hold any numbers.
struct alignas(k_alignment) PlaneGroup {
  static constexpr std::size_t rows_of_long(std::size_t corners) { return (corners + k_lanes - 1) / k_lanes; }
  static constexpr std::size_t k_longest = 512;  ///< corners

  double x[k_lanes], y[k_lanes], z[k_lanes];  ///< unit normals, meaningless where degenerate
  std::uint32_t first_row = 0;
  std::uint32_t corners = 0;
  bool is_long = false;
  std::uint32_t degenerate = 0;  ///< bit i: polygon i; like the normals what plane_normal() says
  std::uint32_t faces_away = 0;  ///< n . (first corner - eye) >= 0
};
void find_planes(std::span<PlaneGroup> groups, const Row* rows, const V3d& eye);

// ----------------------------------------------------------------------------------------------- vertices

/// points <- points * m for an m whose last column is 0 0 0 1. codes: bit k set where a point lies outside
/// plane k of clip_to_frustum(), in its order. Returns the bits set for any of them, those that
/// fill up the last lanes included.
std::uint32_t transform_points(const M44d& m, const Frustum& frustum, std::size_t n, PointArrays points,
                               std::uint32_t* codes);

/// directions <- unit vectors of directions times the directional part of m. Returns whether there is a zero
/// vector among the first n results.
bool transform_directions(const M44d& m, std::size_t n, PointArrays directions);

/// Device coordinates as DeviceMapping::to_device() has them.
void project(const DeviceMapping::Terms& mapping, std::size_t n, PointArrays points, std::int32_t* x,
             std::int32_t* y, std::int32_t* z);

/// A light as it meets one material. Point lights and directional ones are computed from their position; for
/// all others `prepared` has what illuminate() says for every point.
struct LightRow {
  enum class Kind : std::uint8_t { point, directional, prepared };
  Kind kind = Kind::point;
  V3d position;  ///< directional: unit vector towards it
  Rgb color;
  Rgb tint;  ///< color * the material's
  struct Prepared {
    const double *to_x, *to_y, *to_z, *fraction;
  } prepared{};
};

/// The reflection model of one material (shading/reflection.h) with the eye at the origin.
struct Reflection {
  Rgb ambient;  ///< ka times the material's colour
  Rgb color;    ///< the material's
  double kd = 0, ks = 0, shine = 0;
  std::span<const LightRow> lights;
  double color_max = 255;
};

/// reflect(), then colours of the device: red | green << 16, blue.
void light(const Reflection& reflection, std::size_t n, PointArrays points, PointArrays normals,
           std::uint32_t* red_green, std::uint32_t* blue);

/// Nearest and farthest of p.x * cx + p.y * cy + p.z * cz + c over all points, starting from the values
/// given.
void depth_range(std::span<const V3d> points, double cx, double cy, double cz, double c, double& nearest,
                 double& farthest);

}  // namespace farop::batched
