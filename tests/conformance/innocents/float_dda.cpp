// SPDX-License-Identifier: GPL-3.0-or-later
// The floating-point DDA of most textbooks, done with care: crossings and depths are added up from row to row
// in double, colours from pixel to pixel in float. A crossing with a row is a multiple of 1/dy, so two that
// are not equal differ by at least 1/32767; 32767 additions of numbers below 2^15 err by less than 1e-6. So
// ceil(x - 1e-5) is exact.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "farop/rasterizer.h"

namespace {

const farop_host* host;
const farop_frame* frame;
std::vector<std::int32_t> depth;

struct Edge {
  int first, end;  ///< rows
  double x, dx;
  double z, dz;
  float color[3], change[3];
};

farop_status begin_frame(void*, const farop_frame* given) {
  if (given->subpixel_bits != 0) {
    host->log(host, FAROP_LOG_ERROR, "float_dda: whole pixels only");
    return FAROP_E_UNSUPPORTED;
  }
  try {
    depth.assign(static_cast<std::size_t>(given->width) * static_cast<std::size_t>(given->height), INT32_MAX);
  } catch (const std::bad_alloc&) {
    return FAROP_E_MEMORY;
  }
  frame = given;
  return FAROP_OK;
}

Edge edge_of(const farop_vertex& low, const farop_vertex& high) {
  const double dy = high.y - low.y;
  Edge e{low.y,
         high.y,
         static_cast<double>(low.x),
         (high.x - low.x) / dy,
         static_cast<double>(low.z),
         (high.z - low.z) / dy,
         {},
         {}};
  const std::uint8_t from[] = {low.r, low.g, low.b}, to[] = {high.r, high.g, high.b};
  for (int i = 0; i < 3; ++i) {
    e.color[i] = from[i];
    e.change[i] = static_cast<float>((to[i] - from[i]) / dy);
  }
  return e;
}

void step(Edge& e) {
  e.x += e.dx;
  e.z += e.dz;
  for (int i = 0; i < 3; ++i) e.color[i] += e.change[i];
}

int column(double x) {
  return static_cast<int>(std::ceil(x - 1e-5));
}

std::uint8_t byte(float value) {
  return static_cast<std::uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f));
}

void fill(int row, const Edge& left, const Edge& right) {
  const int first = column(left.x), end = column(right.x);
  if (first >= end) return;
  const double per_column = 1 / (right.x - left.x), start = first - left.x;
  const double dz = (right.z - left.z) * per_column;
  double z = left.z + start * dz;
  float color[3], change[3];
  for (int i = 0; i < 3; ++i) {
    change[i] = static_cast<float>((right.color[i] - left.color[i]) * per_column);
    color[i] = left.color[i] + static_cast<float>(start) * change[i];
  }
  std::int32_t* nearest = &depth[static_cast<std::size_t>(row) * static_cast<std::size_t>(frame->width) +
                                 static_cast<std::size_t>(first)];
  std::uint8_t* pixel = frame->pixels + row * frame->row_bytes + 3 * first;
  for (int x = first; x < end; ++x, ++nearest, pixel += 3) {
    const int rounded = static_cast<int>(std::floor(z + 0.5));
    if (rounded < *nearest) {
      *nearest = rounded;
      for (int i = 0; i < 3; ++i) pixel[i] = byte(color[i]);
    }
    z += dz;
    for (int i = 0; i < 3; ++i) color[i] += change[i];
  }
}

farop_status draw(const farop_polygon& p) {
  const farop_vertex* const v = p.vertices;
  std::vector<Edge> table;
  for (std::uint32_t i = 0; i < p.vertex_count; ++i) {
    const farop_vertex &a = v[i], &b = v[(i + 1) % p.vertex_count];
    if (a.x < 0 || a.x >= frame->width || a.y < 0 || a.y >= frame->height) return FAROP_E_INVALID;
    if (a.y != b.y) table.push_back(a.y < b.y ? edge_of(a, b) : edge_of(b, a));
  }
  std::sort(table.begin(), table.end(), [](const Edge& a, const Edge& b) { return a.first < b.first; });
  std::vector<Edge> active;
  std::size_t next = 0;
  for (int row = table.empty() ? 0 : table[0].first; next < table.size() || !active.empty(); ++row) {
    for (Edge& e : active) step(e);
    active.erase(std::remove_if(active.begin(), active.end(), [&](const Edge& e) { return e.end <= row; }),
                 active.end());
    for (; next < table.size() && table[next].first == row; ++next) active.push_back(table[next]);
    // Where two cross or touch, the order within the round-off changes no pixel.
    const auto less = [](const Edge& a, const Edge& b) { return a.x < b.x; };
    if (!std::is_sorted(active.begin(), active.end(), less)) std::sort(active.begin(), active.end(), less);
    for (std::size_t k = 0; k + 1 < active.size(); k += 2) fill(row, active[k], active[k + 1]);
  }
  return FAROP_OK;
}

farop_status polygon(void*, const farop_polygon* p) {
  try {
    return draw(*p);
  } catch (const std::bad_alloc&) {
    return FAROP_E_MEMORY;
  }
}

farop_status end_frame(void*) {
  return FAROP_OK;
}

}  // namespace

const farop_rasterizer* farop_rasterizer_entry(const farop_host* given) {
  host = given;
  static const farop_rasterizer table = {sizeof table,
                                         FAROP_ABI_VERSION,
                                         "float_dda",
                                         "DDA in floating point, with ceil",
                                         0,
                                         0,
                                         nullptr,
                                         nullptr,
                                         begin_frame,
                                         polygon,
                                         end_frame};
  return &table;
}
