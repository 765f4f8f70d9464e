// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of all rasterizers share: polygons, planes through them, and depth measured from outside.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/screen_polygon.h"
#include "plugins/plugin_driver.h"
#include "raster/reference.h"
#include "unit/raster/raster_test_support.h"

namespace farop::test {

/// Twice the signed area; > 0 counter-clockwise.
inline std::int64_t twice_area(const Corners& corners) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ScreenVertex &a = corners[i], &b = corners[(i + 1) % corners.size()];
    sum += std::int64_t{a.x} * b.y - std::int64_t{b.x} * a.y;
  }
  return sum;
}

/// As a host sends it: clockwise ones are flagged as back-facing, triangles as convex.
inline PluginPolygon plugin_polygon(const Corners& corners) {
  PluginPolygon polygon;
  for (const ScreenVertex& v : corners) {
    polygon.corners.push_back({v.x, v.y, v.z, static_cast<std::uint8_t>(v.r), static_cast<std::uint8_t>(v.g),
                               static_cast<std::uint8_t>(v.b), 0});
  }
  if (corners.size() == 3) polygon.flags |= FAROP_POLYGON_CONVEX;
  if (twice_area(corners) < 0) polygon.flags |= FAROP_POLYGON_BACK_FACING;
  return polygon;
}

inline void paint(Corners& corners, int r, int g, int b) {
  for (ScreenVertex& v : corners) {
    v.r = static_cast<std::uint16_t>(r), v.g = static_cast<std::uint16_t>(g),
    v.b = static_cast<std::uint16_t>(b);
  }
}

enum class Attribute { z, r, g, b };
constexpr Attribute k_attributes[] = {Attribute::z, Attribute::r, Attribute::g, Attribute::b};

inline std::int64_t value_of(const ScreenVertex& v, Attribute attribute) {
  switch (attribute) {
    case Attribute::z:
      return v.z;
    case Attribute::r:
      return v.r;
    case Attribute::g:
      return v.g;
    default:
      return v.b;
  }
}

inline void set_value(ScreenVertex& v, Attribute attribute, std::int64_t value) {
  switch (attribute) {
    case Attribute::z:
      v.z = static_cast<std::int32_t>(value);
      break;
    case Attribute::r:
      v.r = static_cast<std::uint16_t>(value);
      break;
    case Attribute::g:
      v.g = static_cast<std::uint16_t>(value);
      break;
    default:
      v.b = static_cast<std::uint16_t>(value);
      break;
  }
}

/// Any value 0..highest at every corner. (Not planar for more than three corners.)
inline void scatter(Random& random, Corners& corners, Attribute attribute, std::int64_t highest) {
  for (ScreenVertex& v : corners) set_value(v, attribute, random.between(0, highest));
}

/// Integers a, b, c with a x + b y + c in 0..highest at every corner: every way to interpolate agrees on such
/// a polygon, at every sample.
inline void make_planar(Random& random, Corners& corners, Attribute attribute, std::int64_t highest) {
  std::int64_t extent = 1;
  for (const ScreenVertex& v : corners) extent = std::max<std::int64_t>({extent, v.x, v.y});
  const std::int64_t steepest = highest / (2 * extent);
  const std::int64_t a = random.between(-steepest, steepest), b = random.between(-steepest, steepest);
  std::int64_t low = INT64_MAX, high = INT64_MIN;
  for (const ScreenVertex& v : corners) {
    low = std::min(low, a * v.x + b * v.y), high = std::max(high, a * v.x + b * v.y);
  }
  const std::int64_t c = random.between(-low, highest - high);
  for (ScreenVertex& v : corners) set_value(v, attribute, a * v.x + b * v.y + c);
}

/// The exact attribute, where there is one (triangles with area; planar polygons).
inline std::optional<reference::AffineFunction> exact_attribute(const Corners& corners, Attribute attribute) {
  std::vector<std::int64_t> values;
  for (const ScreenVertex& v : corners) values.push_back(value_of(v, attribute));
  return reference::AffineFunction::through(corners, values);
}

/// The unit square whose only sample is (x, y), at one depth: as two triangles, so that every rasterizer can
/// draw it. They share the diagonal, which gives the sample to exactly one of them.
inline void add_probe(std::vector<PluginPolygon>& scene, int x, int y, std::int64_t z, int r, int g, int b) {
  const Corners square = rectangle(x, y, x + 1, y + 1, static_cast<int>(z), r, g, b);
  scene.push_back(plugin_polygon({square[0], square[1], square[2]}));
  scene.push_back(plugin_polygon({square[0], square[2], square[3]}));
}

struct Sample {
  int x = 0, y = 0;
};

/// Depth of a scene at each of the samples, found by drawing probes over it and bisecting all samples at
/// once: the farthest probe that still shows, -1 if none does. Where the first drawn wins ties, the depth
/// that the rasterizer stored is this number + 1. Samples of the last column and row cannot be probed.
inline std::vector<std::int64_t> measured_depth(PluginDriver& driver, PluginFrame frame,
                                                std::vector<PluginPolygon> scene,
                                                std::span<const Sample> samples) {
  frame.background = {};
  for (PluginPolygon& polygon : scene) {
    for (farop_vertex& v : polygon.corners) v.r = v.g = v.b = 0;
  }
  const std::size_t polygons = scene.size();
  std::vector<std::int64_t> shows(samples.size(), -1), hidden(samples.size(), std::int64_t{frame.z_far} + 1);
  const auto middle = [&](std::size_t i) { return shows[i] + (hidden[i] - shows[i]) / 2; };
  for (bool open = true; open;) {
    open = false;
    scene.resize(polygons);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (hidden[i] - shows[i] > 1) add_probe(scene, samples[i].x, samples[i].y, middle(i), 255, 255, 255);
    }
    if (scene.size() == polygons) break;
    const PluginPicture picture = driver.draw(frame, scene);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (hidden[i] - shows[i] <= 1) continue;
      (picture.at(samples[i].x, samples[i].y)[0] == 255 ? shows : hidden)[i] = middle(i);
      open = open || hidden[i] - shows[i] > 1;
    }
  }
  return shows;
}

/// 1 where a polygon alone changes the background, row by row from the bottom.
inline std::vector<std::uint8_t> drawn_coverage(PluginDriver& driver, const PluginFrame& frame,
                                                Corners corners) {
  paint(corners, 200, 150, 250);
  const PluginPicture picture = driver.draw(frame, std::vector{plugin_polygon(corners)});
  std::vector<std::uint8_t> covered;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    covered.push_back(picture.rgb[i] != frame.background[0] ? 1 : 0);
  }
  return covered;
}

}  // namespace farop::test
