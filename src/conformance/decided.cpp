// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/decided.h"

#include <optional>

namespace farop::conformance {
namespace {

/// The one corner's colour that may be seen, or nothing where several polygons may be. -1: the background.
std::optional<int> certain_color(const Expectation& e, int x, int y) {
  if (!window_of(e.drawing().frame).contains(x, y)) return std::nullopt;
  const auto covering = e.covering(x, y);
  if (covering.empty()) return -1;
  std::uint32_t seen = covering.front();
  if (covering.size() > 1) {
    const auto admissible = e.admissible(x, y);
    if (admissible.size() != 1) return std::nullopt;
    seen = admissible.front();
  }
  const ScreenVertex& v = e.polygons()[seen].corners.front();
  return v.r << 16 | v.g << 8 | v.b;
}

}  // namespace

Bitmap decided_alike(const Expectation& a, const Expectation& b, const Window& window, int shift_x,
                     int shift_y) {
  Bitmap alike(window);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const auto one = certain_color(a, x, y), two = certain_color(b, x + shift_x, y + shift_y);
      alike.set(x, y, one && one == two ? 1 : 0);
    }
  }
  return alike;
}

}  // namespace farop::conformance
