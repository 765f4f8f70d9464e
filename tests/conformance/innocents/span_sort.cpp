// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons of any shape without tables: on every row the crossings with all edges are found anew, as exact
// fractions, and sorted. Depth and colour in double along the spans; depths are kept in units of 1/256. Of
// equals the last drawn stays.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "farop/rasterizer.h"

namespace {

const farop_frame* frame;
std::vector<std::int64_t> depth;

/// At (whole + rest / dy) pixels, 0 <= rest < dy; values there.
struct Crossing {
  std::int64_t whole, rest, dy;
  double value[4];
};

bool operator<(const Crossing& a, const Crossing& b) {
  return a.whole != b.whole ? a.whole < b.whole : a.rest * b.dy < b.rest * a.dy;
}

farop_status begin_frame(void*, const farop_frame* given) {
  try {
    depth.assign(static_cast<std::size_t>(given->width) * static_cast<std::size_t>(given->height), INT64_MAX);
  } catch (const std::bad_alloc&) {
    return FAROP_E_MEMORY;
  }
  frame = given;
  return FAROP_OK;
}

/// On the horizontal line through row `row`, if the edge a - b crosses it with its lower end counted and not
/// its upper one.
bool cross(const farop_vertex& a, const farop_vertex& b, int row, Crossing& crossing) {
  const farop_vertex &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
  const int bits = frame->subpixel_bits;
  const std::int64_t y = std::int64_t{row} << bits;
  if (y < low.y || y >= high.y) return false;
  const std::int64_t up = y - low.y, rise = std::int64_t{high.y} - low.y;
  const std::int64_t dy = rise << bits,
                     x = low.x * rise + up * (std::int64_t{high.x} - low.x);  // x / dy pixels
  crossing.whole = x / dy, crossing.rest = x % dy, crossing.dy = dy;
  const double t = static_cast<double>(up) / static_cast<double>(rise);
  const int from[] = {low.z, low.r, low.g, low.b}, to[] = {high.z, high.r, high.g, high.b};
  for (int i = 0; i < 4; ++i) crossing.value[i] = from[i] + t * (to[i] - from[i]);
  return true;
}

void fill(int row, const Crossing& left, const Crossing& right) {
  const auto ceil = [](const Crossing& c) { return static_cast<int>(c.whole + (c.rest > 0 ? 1 : 0)); };
  const double left_rest = static_cast<double>(left.rest) / static_cast<double>(left.dy);
  const double right_rest = static_cast<double>(right.rest) / static_cast<double>(right.dy);
  const double width = static_cast<double>(right.whole - left.whole) + (right_rest - left_rest);
  for (int x = ceil(left); x < ceil(right); ++x) {
    const double t = std::min((static_cast<double>(x - left.whole) - left_rest) / width, 1.0);
    const auto at = [&](int i) { return left.value[i] + t * (right.value[i] - left.value[i]); };
    std::int64_t& nearest = depth[static_cast<std::size_t>(row) * static_cast<std::size_t>(frame->width) +
                                  static_cast<std::size_t>(x)];
    const std::int64_t z = std::llround(256 * at(0));
    if (z > nearest) continue;
    nearest = z;
    std::uint8_t* const pixel = frame->pixels + row * frame->row_bytes + 3 * x;
    for (int i = 0; i < 3; ++i) pixel[i] = static_cast<std::uint8_t>(std::lround(at(i + 1)));
  }
}

farop_status polygon(void*, const farop_polygon* p) {
  const int bits = frame->subpixel_bits, right = (frame->width - 1) << bits,
            top = (frame->height - 1) << bits;
  const farop_vertex* const v = p->vertices;
  int low = top, high = 0;
  for (std::uint32_t i = 0; i < p->vertex_count; ++i) {
    if (v[i].x < 0 || v[i].x > right || v[i].y < 0 || v[i].y > top) return FAROP_E_INVALID;
    low = std::min(low, v[i].y), high = std::max(high, v[i].y);
  }
  try {
    std::vector<Crossing> crossings;
    for (int row = low >> bits; row <= high >> bits; ++row) {
      crossings.clear();
      for (std::uint32_t i = 0; i < p->vertex_count; ++i) {
        Crossing crossing;
        if (cross(v[i], v[(i + 1) % p->vertex_count], row, crossing)) crossings.push_back(crossing);
      }
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) fill(row, crossings[k], crossings[k + 1]);
    }
  } catch (const std::bad_alloc&) {
    return FAROP_E_MEMORY;
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
                                         "span_sort",
                                         "sorts the crossings of every row",
                                         0,
                                         0,
                                         nullptr,
                                         nullptr,
                                         begin_frame,
                                         polygon,
                                         end_frame};
  return &table;
}
