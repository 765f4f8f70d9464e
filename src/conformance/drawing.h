// SPDX-License-Identifier: GPL-3.0-or-later
// One picture to be drawn: a frame and its polygons, in whole pixels, y up.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "conformance/result.h"
#include "core/screen_polygon.h"

namespace farop::conformance {

struct Drawing {
  Resolution frame{64, 64, 512, 256};
  std::vector<TestPolygon> polygons;
};

/// Half-open rectangle of samples: x0 <= x < x1, y0 <= y < y1.
struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  std::size_t samples() const {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>(x - x0);
  }
};

/// The whole frame.
Window window_of(const Resolution& frame);
/// Samples of the closed bounding box, grown by `margin` on all sides, within the frame.
Window bounds(std::span<const ScreenVertex> polygon, const Resolution& frame, int margin = 0);

/// A byte per sample of a window.
struct Bitmap {
  Window window;
  std::vector<std::uint8_t> at;

  explicit Bitmap(const Window& w = {}) : window(w), at(w.samples()) {}
  std::uint8_t get(int x, int y) const { return window.contains(x, y) ? at[window.index(x, y)] : 0; }
  void set(int x, int y, std::uint8_t value) {
    if (window.contains(x, y)) at[window.index(x, y)] = value;
  }
};

/// Twice the signed area, > 0 counter-clockwise; exact for coordinates below 2^30 in size.
std::int64_t twice_area(std::span<const ScreenVertex> polygon);

/// The drawing in the form that the sinks of the pipeline take; clockwise polygons are marked back-facing.
ScreenPolygonBatch to_batch(const Drawing& drawing);
ScreenFrame to_frame(const Drawing& drawing);

/// The drawing as a flat file; nothing where a coordinate is outside the frame.
std::string flat_text(const Drawing& drawing);

/// A corner of one depth and colour.
ScreenVertex corner(int x, int y, std::int64_t z, const Color& color);
/// Every corner in one colour and at one depth.
void paint(TestPolygon& polygon, const Color& color);
void set_depth(TestPolygon& polygon, std::int64_t z);

}  // namespace farop::conformance
