// SPDX-License-Identifier: GPL-3.0-or-later
// A half-space rasterizer for triangles (J. Pineda, "A Parallel Algorithm for Polygon Rasterization",
// SIGGRAPH 1988): three edge functions say whether a sample is inside, a plane gives its depth and colours;
// all in whole numbers. Compiled with -DMUTANT=n it has exactly one fault, the n-th of manifest.tsv; without,
// none.
#include <algorithm>
#include <utility>

#include "entry.h"
#include "span.h"

namespace {

using Corner = const farop_vertex&;

/// > 0: (x, y) lies to the left of a -> b. In units of 1/4 square pixel, for 17.
std::int64_t edge_function(Corner a, Corner b, int x, int y) {
  // 17 half-centre: asks for the middle of a pixel that has its middle at whole numbers already.
  const int shift = k_mutant == 17 ? 1 : 0;
  return std::int64_t{2} * (b.x - a.x) * (2 * (y - a.y) + shift) -
         std::int64_t{2} * (b.y - a.y) * (2 * (x - a.x) + shift);
}

/// Whether samples exactly on a -> b, an edge of a triangle that runs counter-clockwise, belong to the
/// triangle. Left and bottom edges do: those that go down and, of the level ones, those that go right.
bool owns(Corner a, Corner b) {
  const bool down = a.y > b.y, up = a.y < b.y, right = a.x<b.x, left = a.x> b.x;
  switch (k_mutant) {
    // 4 lb', 5 lt', 6 rb', 7 rt': the right two questions in the wrong order. Level edges should come last.
    case 4:
      return right || (!left && down);
    case 5:
      return left || (!right && down);
    case 6:
      return right || (!left && up);
    case 7:
      return left || (!right && up);
    case 8:  // 8 closed: w >= 0 three times
      return true;
    case 14:  // 14 open: w > 0 three times
      return false;
    default:
      return down || (!up && right);
  }
}

class HalfSpace {
 public:
  void begin(const farop_frame& frame) { canvas_.begin(frame); }
  void polygon(const farop_polygon& polygon);
  void end() {}

 private:
  Canvas canvas_;
};

/// a(x, y) = (at_origin + per_column (x - x0) + per_row (y - y0)) / area
struct Plane {
  Int128 at_origin, per_column, per_row;
};

Plane plane_of(Corner a, Corner b, Corner c, std::int64_t area, int attribute) {
  const std::int64_t u = attribute_of(b, attribute) - attribute_of(a, attribute);
  const std::int64_t v = attribute_of(c, attribute) - attribute_of(a, attribute);
  Plane plane{Int128{attribute_of(a, attribute)} * area, Int128{u} * (c.y - a.y) - Int128{v} * (b.y - a.y),
              Int128{v} * (b.x - a.x) - Int128{u} * (c.x - a.x)};
  if (k_mutant == 47 && attribute == k_z) std::swap(plane.per_column, plane.per_row);  // 47: dz/dx and dz/dy
  return plane;
}

void HalfSpace::polygon(const farop_polygon& polygon) {
  farop_vertex a = polygon.vertices[0], b = polygon.vertices[1], c = polygon.vertices[2];
  const auto twice_area = [&] {
    return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
  };
  // 27: takes one order of the corners for granted (clockwise on a screen whose y points down), and skips
  // this line.
  if (k_mutant != 27 && twice_area() < 0) std::swap(b, c);
  const std::int64_t area = twice_area();
  if (area == 0) return;

  Plane planes[k_attributes];
  for (int v = 0; v < k_attributes; ++v) planes[v] = plane_of(a, b, c, area, v);

  auto [x_low, x_high] = std::minmax({a.x, b.x, c.x});
  auto [y_low, y_high] = std::minmax({a.y, b.y, c.y});
  if constexpr (k_mutant == 66) {
    // 66: no bounding box: asks every pixel of the frame about every triangle.
    x_low = y_low = 0, x_high = canvas_.width() - 1, y_high = canvas_.height() - 1;
  }
  const farop_vertex* const edges[][2] = {{&a, &b}, {&b, &c}, {&c, &a}};
  const auto inside = [&](int x, int y) {
    for (const auto& edge : edges) {
      const std::int64_t w = edge_function(*edge[0], *edge[1], x, y);
      // 33: an epsilon against round-off, in units of the whole triangle.
      if (k_mutant == 33 && static_cast<double>(w) > -1e-3 * 4 * static_cast<double>(area)) continue;
      if (w < 0 || (w == 0 && !owns(*edge[0], *edge[1]))) return false;
    }
    return true;
  };
  for (int y = y_low; y <= y_high; ++y) {
    Ramp ramps[k_attributes];
    bool started = false;
    for (int x = x_low; x <= x_high; ++x) {
      if (!inside(x, y)) continue;  // the samples of a row that are inside stand together
      for (int v = 0; v < k_attributes; ++v) {
        const Plane& p = planes[v];
        if (started) {
          ramps[v].next();
        } else {
          ramps[v] = Ramp(p.at_origin + p.per_column * (x - a.x) + p.per_row * (y - a.y), p.per_column, area);
        }
      }
      started = true;
      const auto byte = [&](int v) { return static_cast<std::uint8_t>(ramps[v].value()); };
      canvas_.put(x, y, ramps[k_z].value(), {byte(k_red), byte(k_green), byte(k_blue)});
    }
  }
}

}  // namespace

const farop_rasterizer* farop_rasterizer_entry(const farop_host*) {
  return Entry<HalfSpace>::table("half-spaces and depth buffer, for testing the tests", FAROP_WANT_TRIANGLES);
}
