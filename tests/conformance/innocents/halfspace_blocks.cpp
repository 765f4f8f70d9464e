// SPDX-License-Identifier: GPL-3.0-or-later
// Half-spaces in 64-bit integers, by blocks of 8 x 8 samples: a block is left out or drawn without further
// questions where its corners say enough (J. McCormack and R. McNamara, "Tiled Polygon Traversal Using
// Half-Plane Edge Functions", Graphics Hardware 2000). Depth and colour from the plane, rounded down.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

#include "farop/rasterizer.h"

namespace {

__extension__ using Int128 = __int128;

const farop_frame* frame;
std::vector<std::int32_t> depth;
constexpr int k_block = 8;

/// A x + B y + C at sample (x, y).
struct Linear {
  std::int64_t a, b, c;
  std::int64_t at(int x, int y) const { return a * x + b * y + c; }
  std::int64_t least(int x, int y) const {
    return at(a > 0 ? x : x + k_block - 1, b > 0 ? y : y + k_block - 1);
  }
  std::int64_t most(int x, int y) const {
    return at(a > 0 ? x + k_block - 1 : x, b > 0 ? y + k_block - 1 : y);
  }
};

/// > 0 to the left of p -> q; samples on it have 0 where it is the triangle's (left, bottom), and -1 where it
/// is not.
Linear edge(const farop_vertex& p, const farop_vertex& q) {
  const std::int64_t a = std::int64_t{p.y} - q.y, b = std::int64_t{q.x} - p.x;
  const bool belongs = a > 0 || (a == 0 && b > 0);
  const int bits = frame->subpixel_bits;
  return {a << bits, b << bits, -(a * p.x + b * p.y) - (belongs ? 0 : 1)};
}

struct Plane {
  Int128 x, y, origin;
  std::int64_t area;
  int at(int column, int row) const {
    const Int128 sum = origin + x * column + y * row;
    return static_cast<int>(sum / area - (sum % area < 0 ? 1 : 0));
  }
};

farop_status begin_frame(void*, const farop_frame* given) {
  try {
    depth.assign(static_cast<std::size_t>(given->width) * static_cast<std::size_t>(given->height), INT32_MAX);
  } catch (const std::bad_alloc&) {
    return FAROP_E_MEMORY;
  }
  frame = given;
  return FAROP_OK;
}

void draw(const Plane* planes, int x, int y) {
  std::int32_t& nearest = depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame->width) +
                                static_cast<std::size_t>(x)];
  const int z = planes[0].at(x, y);
  if (z >= nearest) return;
  nearest = z;
  std::uint8_t* const pixel = frame->pixels + y * frame->row_bytes + 3 * x;
  for (int i = 0; i < 3; ++i) pixel[i] = static_cast<std::uint8_t>(planes[i + 1].at(x, y));
}

farop_status polygon(void*, const farop_polygon* p) {
  farop_vertex a = p->vertices[0], b = p->vertices[1], c = p->vertices[2];
  const int bits = frame->subpixel_bits, right = (frame->width - 1) << bits,
            top = (frame->height - 1) << bits;
  for (const farop_vertex& v : {a, b, c}) {
    if (v.x < 0 || v.x > right || v.y < 0 || v.y > top) return FAROP_E_INVALID;
  }
  const auto area_of = [&] {
    return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
  };
  if (area_of() < 0) std::swap(b, c);
  const std::int64_t area = area_of();
  if (area == 0) return FAROP_OK;

  Plane planes[4];
  const int values[4][3] = {{a.z, b.z, c.z}, {a.r, b.r, c.r}, {a.g, b.g, c.g}, {a.b, b.b, c.b}};
  for (int i = 0; i < 4; ++i) {
    const std::int64_t u = std::int64_t{values[i][1]} - values[i][0],
                       v = std::int64_t{values[i][2]} - values[i][0];
    const Int128 x = Int128{u} * (c.y - a.y) - Int128{v} * (b.y - a.y);
    const Int128 y = Int128{v} * (b.x - a.x) - Int128{u} * (c.x - a.x);
    planes[i] = {x << bits, y << bits, Int128{values[i][0]} * area - x * a.x - y * a.y, area};
  }
  const Linear edges[] = {edge(a, b), edge(b, c), edge(c, a)};
  const auto [x_low, x_high] = std::minmax({a.x, b.x, c.x});
  const auto [y_low, y_high] = std::minmax({a.y, b.y, c.y});
  for (int by = (y_low >> bits) & -k_block; by <= y_high >> bits; by += k_block) {
    for (int bx = (x_low >> bits) & -k_block; bx <= x_high >> bits; bx += k_block) {
      bool outside = false, inside = true;
      for (const Linear& e : edges) {
        outside = outside || e.most(bx, by) < 0;
        inside = inside && e.least(bx, by) >= 0;
      }
      if (outside) continue;
      for (int y = by; y < std::min(by + k_block, frame->height); ++y) {
        for (int x = bx; x < std::min(bx + k_block, frame->width); ++x) {
          if (inside || (edges[0].at(x, y) >= 0 && edges[1].at(x, y) >= 0 && edges[2].at(x, y) >= 0))
            draw(planes, x, y);
        }
      }
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
                                         "halfspace_blocks",
                                         "half-spaces by blocks, in integers",
                                         FAROP_WANT_TRIANGLES,
                                         0,
                                         nullptr,
                                         nullptr,
                                         begin_frame,
                                         polygon,
                                         end_frame};
  return &table;
}
