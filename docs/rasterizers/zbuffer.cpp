// SPDX-License-Identifier: GPL-3.0-or-later
// A z-buffer for triangles. Build: c++ -std=c++17 -O2 -fPIC -shared -I plugins/include zbuffer.cpp -o zbuffer_cpp.so
#include <farop/rasterizer.h>
#include <algorithm>
#include <vector>
namespace {
using Corner = const farop_vertex&;
const farop_frame* frame;
std::vector<int32_t> depth;
farop_status begin_frame(void*, const farop_frame* f) try {
  depth.assign(size_t(f->width) * size_t(f->height), INT32_MAX);  // beyond the far plane
  return frame = f, FAROP_OK;
} catch (...) {  // no exception may leave
  return FAROP_E_MEMORY;
}
int64_t edge(Corner a, Corner b, int x, int y) {  // > 0: (x, y) lies left of a -> b
  return int64_t{b.x - a.x} * (y - a.y) - int64_t{b.y - a.y} * (x - a.x);
}  // Samples on an edge that goes up (a right one) or, level, to the left (a top one) are the neighbour's:
bool lost(Corner a, Corner b) { return a.y < b.y || (a.y == b.y && a.x > b.x); }
farop_status polygon(void*, const farop_polygon* p) {
  farop_vertex a = p->vertices[0], b = p->vertices[1], c = p->vertices[2];
  if (edge(a, b, c.x, c.y) < 0) std::swap(a, b);  // counter-clockwise from here on
  const int64_t area = edge(a, b, c.x, c.y);
  const auto [x_min, x_max] = std::minmax({a.x, b.x, c.x});
  const auto [y_min, y_max] = std::minmax({a.y, b.y, c.y});
  const int bits = frame->subpixel_bits, pixel = 1 << bits;
  for (int y = y_min & -pixel; area != 0 && y <= y_max; y += pixel) {
    for (int x = x_min & -pixel; x <= x_max; x += pixel) {
      const int64_t u = edge(b, c, x, y), v = edge(c, a, x, y), w = edge(a, b, x, y);
      if (u < lost(b, c) || v < lost(c, a) || w < lost(a, b)) continue;
      const auto mix = [&](int at_a, int at_b, int at_c) {
        return int((double(u) * at_a + double(v) * at_b + double(w) * at_c) / double(area) + 0.5);
      };
      int32_t& nearest = depth[size_t(y >> bits) * size_t(frame->width) + size_t(x >> bits)];
      const int32_t z = mix(a.z, b.z, c.z);
      if (z >= nearest) continue;  // of equal depths the first drawn stays
      nearest = z;
      const int rgb[] = {mix(a.r, b.r, c.r), mix(a.g, b.g, c.g), mix(a.b, b.b, c.b)};
      std::copy_n(rgb, 3, frame->pixels + (y >> bits) * frame->row_bytes + 3 * (x >> bits));
    }
  }
  return FAROP_OK;
}
farop_status end_frame(void*) { return FAROP_OK; }
const farop_rasterizer table = {
    sizeof table, FAROP_ABI_VERSION, "zbuffer_cpp", "z-buffer in C++", FAROP_WANT_TRIANGLES, 0, nullptr,
    nullptr,      begin_frame,       polygon,       end_frame};
}  // namespace
const farop_rasterizer* farop_rasterizer_entry(const farop_host*) { return &table; }
