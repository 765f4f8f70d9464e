// SPDX-License-Identifier: GPL-3.0-or-later
// Barycentric coordinates in double: products of differences of coordinates are whole numbers below 2^53, so
// the signs are exact and only the interpolation rounds. To nearest; of equal depths the first drawn stays.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

#include "farop/rasterizer.h"

namespace {

const farop_frame* frame;
std::vector<std::int32_t> depth;

struct Point {
  double x, y;
};

double cross(Point a, Point b, Point p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Of a sample with weight w for the edge a -> b, counter-clockwise: left and bottom edges belong.
bool belongs(double w, Point a, Point b) {
  if (w != 0) return w > 0;
  return b.y < a.y || (b.y == a.y && b.x > a.x);
}

farop_status begin_frame(void*, const farop_frame* given) {
  try {
    depth.assign(static_cast<std::size_t>(given->width) * static_cast<std::size_t>(given->height), INT32_MAX);
  } catch (const std::bad_alloc&) {
    return FAROP_E_MEMORY;
  }
  frame = given;
  return FAROP_OK;
}

farop_status polygon(void*, const farop_polygon* p) {
  farop_vertex v[] = {p->vertices[0], p->vertices[1], p->vertices[2]};
  const double scale = std::ldexp(1.0, -frame->subpixel_bits);
  Point at[3];
  const auto place = [&] {
    for (int i = 0; i < 3; ++i) at[i] = {v[i].x * scale, v[i].y * scale};
  };
  place();
  for (const Point& corner : at) {
    if (corner.x < 0 || corner.x > frame->width - 1 || corner.y < 0 || corner.y > frame->height - 1)
      return FAROP_E_INVALID;
  }
  if (cross(at[0], at[1], at[2]) < 0) std::swap(v[1], v[2]);
  place();
  const double area = cross(at[0], at[1], at[2]);
  if (area == 0) return FAROP_OK;

  const auto [x_low, x_high] = std::minmax({at[0].x, at[1].x, at[2].x});
  const auto [y_low, y_high] = std::minmax({at[0].y, at[1].y, at[2].y});
  const int first_x = static_cast<int>(std::ceil(x_low)), last_x = static_cast<int>(std::floor(x_high));
  for (int y = static_cast<int>(std::ceil(y_low)); y <= std::floor(y_high); ++y) {
    for (int x = first_x; x <= last_x; ++x) {
      const Point sample{static_cast<double>(x), static_cast<double>(y)};
      const double w[] = {cross(at[1], at[2], sample), cross(at[2], at[0], sample),
                          cross(at[0], at[1], sample)};
      if (!belongs(w[0], at[1], at[2]) || !belongs(w[1], at[2], at[0]) || !belongs(w[2], at[0], at[1]))
        continue;
      const auto mix = [&](int a, int b, int c) {
        return static_cast<int>(std::floor((w[0] * a + w[1] * b + w[2] * c) / area + 0.5));
      };
      std::int32_t& nearest = depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame->width) +
                                    static_cast<std::size_t>(x)];
      const int z = mix(v[0].z, v[1].z, v[2].z);
      if (z >= nearest) continue;
      nearest = z;
      std::uint8_t* const pixel = frame->pixels + y * frame->row_bytes + 3 * x;
      pixel[0] = static_cast<std::uint8_t>(mix(v[0].r, v[1].r, v[2].r));
      pixel[1] = static_cast<std::uint8_t>(mix(v[0].g, v[1].g, v[2].g));
      pixel[2] = static_cast<std::uint8_t>(mix(v[0].b, v[1].b, v[2].b));
    }
  }
  return FAROP_OK;
}

farop_status end_frame(void*) {
  return FAROP_OK;
}

}  // namespace

const farop_rasterizer* farop_rasterizer_entry(const farop_host*) {
  static const farop_rasterizer table = {sizeof table,
                                         FAROP_ABI_VERSION,
                                         "barycentric",
                                         "barycentric coordinates in double",
                                         FAROP_WANT_TRIANGLES,
                                         0,
                                         nullptr,
                                         nullptr,
                                         begin_frame,
                                         polygon,
                                         end_frame};
  return &table;
}
