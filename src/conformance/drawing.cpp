// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace farop::conformance {

Window window_of(const Resolution& frame) {
  return {0, 0, frame.x, frame.y};
}

Window bounds(std::span<const ScreenVertex> polygon, const Resolution& frame, int margin) {
  if (polygon.empty()) return {};
  const auto [left, right] = std::ranges::minmax(polygon, {}, &ScreenVertex::x);
  const auto [bottom, top] = std::ranges::minmax(polygon, {}, &ScreenVertex::y);
  const auto limited = [](std::int64_t value, int high) {
    return static_cast<int>(std::clamp<std::int64_t>(value, 0, high));
  };
  Window w{limited(std::int64_t{left.x} - margin, frame.x), limited(std::int64_t{bottom.y} - margin, frame.y),
           limited(std::int64_t{right.x} + margin + 1, frame.x),
           limited(std::int64_t{top.y} + margin + 1, frame.y)};
  w.x1 = std::max(w.x1, w.x0), w.y1 = std::max(w.y1, w.y0);
  return w;
}

std::int64_t twice_area(std::span<const ScreenVertex> polygon) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ScreenVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    // Relative to the first corner, so that far-away polygons stay exact too.
    sum += (std::int64_t{a.x} - polygon[0].x) * (std::int64_t{b.y} - polygon[0].y) -
           (std::int64_t{b.x} - polygon[0].x) * (std::int64_t{a.y} - polygon[0].y);
  }
  return sum;
}

ScreenPolygonBatch to_batch(const Drawing& drawing) {
  ScreenPolygonBatch batch;
  for (const TestPolygon& polygon : drawing.polygons) {
    ScreenPolygonRecord record;
    record.first_vertex = static_cast<std::uint32_t>(batch.vertices.size());
    record.vertex_count = static_cast<std::uint32_t>(polygon.size());
    record.back_facing = twice_area(polygon) < 0;
    batch.polygons.push_back(record);
    batch.vertices.insert(batch.vertices.end(), polygon.begin(), polygon.end());
  }
  return batch;
}

ScreenFrame to_frame(const Drawing& drawing) {
  ScreenFrame frame;
  frame.resolution = drawing.frame;
  for (const TestPolygon& polygon : drawing.polygons)
    frame.max_vertices = std::max(frame.max_vertices, static_cast<std::uint32_t>(polygon.size()));
  frame.max_vertices = std::max(frame.max_vertices, 3u);
  return frame;
}

std::string flat_text(const Drawing& drawing) {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{} {} {} {}\n{}\n1\n", drawing.frame.x, drawing.frame.y, drawing.frame.z,
                 drawing.frame.color, drawing.polygons.size());
  for (const TestPolygon& polygon : drawing.polygons) {
    const auto [bottom, top] = std::ranges::minmax(polygon, {}, &ScreenVertex::y);
    fmt::format_to(out, "{} {} {}\n", polygon.size(), top.y, bottom.y);
    for (const ScreenVertex& v : polygon) {
      if (v.x < 0 || v.x >= drawing.frame.x || v.y < 0 || v.y >= drawing.frame.y) return {};
      fmt::format_to(out, "{} {} {} {} {} {}\n", v.x, v.y, v.z, v.r, v.g, v.b);
    }
    fmt::format_to(out, "1\n");
  }
  fmt::format_to(out, "127\n");
  return text;
}

ScreenVertex corner(int x, int y, std::int64_t z, const Color& color) {
  return {x, y, static_cast<std::int32_t>(z), color[0], color[1], color[2], 0};
}

void paint(TestPolygon& polygon, const Color& color) {
  for (ScreenVertex& v : polygon) v.r = color[0], v.g = color[1], v.b = color[2];
}

void set_depth(TestPolygon& polygon, std::int64_t z) {
  for (ScreenVertex& v : polygon) v.z = static_cast<std::int32_t>(z);
}

}  // namespace farop::conformance
