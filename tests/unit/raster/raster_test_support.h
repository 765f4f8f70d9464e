// SPDX-License-Identifier: GPL-3.0-or-later
// Random polygons and short ways to draw them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/framebuffer.h"
#include "core/screen_polygon.h"
#include "raster/edge_table.h"
#include "raster/internal_rasterizer.h"

namespace farop::test {

using Corners = std::vector<ScreenVertex>;

/// SplitMix64 (G. L. Steele et al., OOPSLA 2014): the same numbers everywhere, unlike std distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  /// low..high, both included.
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  int integer(int low, int high) { return static_cast<int>(between(low, high)); }

 private:
  std::uint64_t state_;
};

inline ScreenVertex vertex(std::int64_t x, std::int64_t y, std::int64_t z = 0, int r = 0, int g = 0,
                           int b = 0) {
  return {static_cast<std::int32_t>(x),
          static_cast<std::int32_t>(y),
          static_cast<std::int32_t>(z),
          static_cast<std::uint16_t>(r),
          static_cast<std::uint16_t>(g),
          static_cast<std::uint16_t>(b),
          0};
}

/// What random corners look like.
enum class Shape {
  triangle,
  star,        ///< simple, mostly concave: points in angular order round the middle
  tangle,      ///< points in any order: crosses itself
  degenerate,  ///< few different coordinates: repeated corners, horizontals, collinear runs, no area
  bridged,     ///< a walk out and back is inserted: an edge used twice
};
constexpr Shape k_shapes[] = {Shape::triangle, Shape::star, Shape::tangle, Shape::degenerate, Shape::bridged};

/// Coordinates low_x..high_x and low_y..high_y; depth and colours 0.
inline Corners random_polygon(Random& random, Shape shape, std::int64_t low_x, std::int64_t high_x,
                              std::int64_t low_y, std::int64_t high_y) {
  const auto any = [&] { return vertex(random.between(low_x, high_x), random.between(low_y, high_y)); };
  Corners corners(static_cast<std::size_t>(shape == Shape::triangle ? 3 : random.integer(3, 12)));
  std::generate(corners.begin(), corners.end(), any);
  if (shape == Shape::star) {
    const double x = 0.5 * static_cast<double>(low_x + high_x), y = 0.5 * static_cast<double>(low_y + high_y);
    const auto angle = [&](const ScreenVertex& v) { return std::atan2(v.y - y, v.x - x); };
    std::sort(corners.begin(), corners.end(),
              [&](const ScreenVertex& a, const ScreenVertex& b) { return angle(a) < angle(b); });
  }
  if (shape == Shape::degenerate) {
    const Corners few = {any(), any(), any()};
    for (ScreenVertex& v : corners) v = vertex(few[random.bits() % 3].x, few[random.bits() % 3].y);
  }
  if (shape == Shape::bridged) {
    const ScreenVertex from = corners[random.bits() % corners.size()];
    const Corners walk = {from, any(), any(), any(), from};
    const auto place = std::find(corners.begin(), corners.end(), from);
    corners.insert(place, walk.begin(), walk.end());
  }
  return corners;
}

/// Of a sample, row by row from the bottom.
inline std::size_t index_of(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

/// Adds 1 to every sample that the spans of a polygon cover.
inline void add_coverage(std::vector<int>& count, EdgeTable& table, std::span<const ScreenVertex> corners,
                         int width) {
  table.load(corners);
  while (table.next_row()) {
    for (const Span& span : table.spans()) {
      for (int x = span.first; x < span.end; ++x) ++count[index_of(x, table.row(), width)];
    }
  }
}

inline ScreenFrame make_frame(int width, int height, int subpixel_bits = 0, std::int64_t depths = 65536,
                              int colors = 256) {
  ScreenFrame frame;
  frame.resolution = {width, height, depths, colors};
  frame.subpixel_bits = subpixel_bits;
  return frame;
}

/// A batch that grows polygon by polygon.
struct Drawing {
  void add(const Corners& corners, const Material* material = nullptr) {
    ScreenPolygonRecord record;
    record.first_vertex = static_cast<std::uint32_t>(batch.vertices.size());
    record.vertex_count = static_cast<std::uint32_t>(corners.size());
    record.material = material;
    batch.polygons.push_back(record);
    batch.vertices.insert(batch.vertices.end(), corners.begin(), corners.end());
  }
  void add(const Corners& corners, const Material* material, const std::vector<V3f>& normals,
           const std::vector<V3f>& eye_positions) {
    add(corners, material);
    batch.normals.insert(batch.normals.end(), normals.begin(), normals.end());
    batch.eye_positions.insert(batch.eye_positions.end(), eye_positions.begin(), eye_positions.end());
  }

  ScreenPolygonBatch batch;
};

inline Framebuffer draw(const ScreenFrame& frame, const Drawing& drawing,
                        InternalRasterizerOptions options = {}) {
  options.keep_depth = true;
  InternalRasterizer rasterizer(options);
  rasterizer.begin_frame(frame);
  rasterizer.polygons(drawing.batch);
  rasterizer.end_frame();
  return rasterizer.take();
}

inline Corners rectangle(int x1, int y1, int x2, int y2, int z, int r, int g, int b) {
  return {vertex(x1, y1, z, r, g, b), vertex(x2, y1, z, r, g, b), vertex(x2, y2, z, r, g, b),
          vertex(x1, y2, z, r, g, b)};
}

inline int red(const Framebuffer& picture, int x, int y) {
  return picture.rgb[3 * picture.pixel(x, y)];
}

}  // namespace farop::test
