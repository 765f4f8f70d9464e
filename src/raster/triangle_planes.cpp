// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/triangle_planes.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace farop {
namespace {

/// Adding it to a double below 2^51 leaves the nearest integer in the low bits (of two the even one).
constexpr double k_to_integer = 0x1.8p52;

std::uint64_t nearest_integer(double v) {
  return std::bit_cast<std::uint64_t>(v + k_to_integer) - std::bit_cast<std::uint64_t>(k_to_integer);
}

auto corner_key(const ScreenVertex& v) {
  return std::tie(v.y, v.x, v.z, v.r, v.g, v.b);
}

bool same_place(const ScreenVertex& a, const ScreenVertex& b) {
  return a.x == b.x && a.y == b.y;
}

}  // namespace

std::optional<std::uint32_t> fan_center(std::span<const ScreenVertex> corners) {
  constexpr std::int32_t k_limit = 1 << 27;
  const auto n = static_cast<std::uint32_t>(corners.size());
  if (n < 3) return std::nullopt;
  std::uint32_t center = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const ScreenVertex& v = corners[i];
    if (v.x < -k_limit || v.x > k_limit || v.y < -k_limit || v.y > k_limit) return std::nullopt;
    if (corner_key(v) < corner_key(corners[center])) center = i;
  }
  if (n == 3) return center;
  const ScreenVertex& middle = corners[center];
  bool left_turns = false, right_turns = false;
  std::uint32_t previous = center + 1 == n ? 0 : center + 1;
  if (same_place(corners[previous], middle)) return std::nullopt;
  for (std::uint32_t i = 2; i < n; ++i) {
    const std::uint32_t next = previous + 1 == n ? 0 : previous + 1;
    if (same_place(corners[next], middle)) return std::nullopt;
    const std::int64_t area = doubled_area(middle, corners[previous], corners[next]);
    left_turns = left_turns || area > 0, right_turns = right_turns || area < 0;
    previous = next;
  }
  if (left_turns && right_turns) return std::nullopt;
  return center;
}

std::optional<std::array<std::uint32_t, 3>> fan_triangle(std::span<const ScreenVertex> corners,
                                                         std::uint32_t center, std::uint32_t i) {
  const auto n = static_cast<std::uint32_t>(corners.size());
  const auto wrapped = [n](std::uint32_t k) { return k < n ? k : k - n; };
  const std::uint32_t b = wrapped(center + i), c = wrapped(center + i + 1);
  const std::int64_t area = doubled_area(corners[center], corners[b], corners[c]);
  if (area == 0) return std::nullopt;
  return area > 0 ? std::array{center, b, c} : std::array{center, c, b};
}

bool is_plane_triangle(const Triangle& t, int subpixel_bits) {
  const auto [low_x, high_x] = std::minmax({t.a.x, t.b.x, t.c.x});
  const auto [low_y, high_y] = std::minmax({t.a.y, t.b.y, t.c.y});
  const auto [low_z, high_z] = std::minmax({t.a.z, t.b.z, t.c.z});
  constexpr std::int32_t k_coordinate = 1 << k_plane_coordinate_bits;
  if (low_x < -k_coordinate || high_x > k_coordinate || low_y < -k_coordinate || high_y > k_coordinate) {
    return false;
  }
  if (low_z < 0 || high_z > (1 << 30)) return false;
  const std::int64_t extent = std::max(high_x - low_x, high_y - low_y);
  if (extent > std::int64_t{1} << (k_plane_extent_bits + subpixel_bits)) return false;
  const std::int64_t area = doubled_area(t.a, t.b, t.c);
  // Colours change by at most 255 * 2 extent / area a vertex unit; that may be 2^26 a pixel.
  if (extent << subpixel_bits > area << 17) return false;
  const std::int64_t range = std::int64_t{high_z} - low_z;
  // What the gradients can be at most; below 2^30 * 2^22 * 2^8. Mostly that is enough.
  const auto limit = static_cast<double>(area) * static_cast<double>(1 << k_plane_gradient_bits);
  if (static_cast<double>((2 * range * extent) << subpixel_bits) <= limit) return true;
  const std::int64_t dzb = std::int64_t{t.b.z} - t.a.z, dzc = std::int64_t{t.c.z} - t.a.z;
  const std::int64_t along_x = dzb * (t.c.y - t.a.y) - dzc * (t.b.y - t.a.y);
  const std::int64_t along_y = dzc * (t.b.x - t.a.x) - dzb * (t.c.x - t.a.x);
  const auto allowed = [&](std::int64_t v) {
    return static_cast<double>((v < 0 ? -v : v) << subpixel_bits) <= limit;
  };
  return allowed(along_x) && allowed(along_y);
}

TrianglePlanes::TrianglePlanes(const Triangle& t, int subpixel_bits) {
  const double bx = t.b.x - t.a.x, by = t.b.y - t.a.y, cx = t.c.x - t.a.x, cy = t.c.y - t.a.y;
  const double scale =
      static_cast<double>(std::int64_t{1} << (k_plane_fraction_bits + subpixel_bits)) / (bx * cy - cx * by);
  // The pixel of corner a, and how far the corner is from it to the right and upwards: 0 <= fraction < 1.
  const int pixel_x = t.a.x >> subpixel_bits, pixel_y = t.a.y >> subpixel_bits;
  const double unit = 1.0 / (1 << subpixel_bits);
  const double fraction_x = (t.a.x - (pixel_x << subpixel_bits)) * unit;
  const double fraction_y = (t.a.y - (pixel_y << subpixel_bits)) * unit;
  const auto plane = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    const double db = b - a, dc = c - a;
    const double step_x = (db * cy - dc * by) * scale, step_y = (dc * bx - db * cx) * scale;
    Plane p;
    p.step_x = nearest_integer(step_x), p.step_y = nearest_integer(step_y);
    p.start = (static_cast<std::uint64_t>(a) << k_plane_fraction_bits) +
              static_cast<std::uint64_t>(k_plane_half) -
              nearest_integer(step_x * fraction_x + step_y * fraction_y);
    p.start = p.at(-pixel_x, -pixel_y);
    return p;
  };
  depth_ = plane(t.a.z, t.b.z, t.c.z);
  color_ = {plane(t.a.r, t.b.r, t.c.r), plane(t.a.g, t.b.g, t.c.g), plane(t.a.b, t.b.b, t.c.b)};
}

Barycentric::Barycentric(const Triangle& t, int subpixel_bits, int x, int y) {
  ScreenVertex sample;
  sample.x = x << subpixel_bits, sample.y = y << subpixel_bits;
  const double scale = 1.0 / static_cast<double>(doubled_area(t.a, t.b, t.c));
  to_b = static_cast<double>(doubled_area(t.a, sample, t.c)) * scale;
  to_c = static_cast<double>(doubled_area(t.a, t.b, sample)) * scale;
}

}  // namespace farop
