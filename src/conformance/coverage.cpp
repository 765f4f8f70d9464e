// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/coverage.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "conformance/wide.h"

namespace farop::conformance {
namespace {

// Rules by the direction in which the sample moves.
constexpr std::uint8_t bits(std::initializer_list<ConsistentRule> rules) {
  std::uint8_t all = 0;
  for (const ConsistentRule rule : rules) all |= rule_bit(rule);
  return all;
}
using enum ConsistentRule;
constexpr std::uint8_t k_up = bits({lb, rb, lb2, rb2});
constexpr std::uint8_t k_down = bits({lt, rt, lt2, rt2});
constexpr std::uint8_t k_right = bits({lb, lt, lb2, lt2});
constexpr std::uint8_t k_x_first = bits({lb, lt, rb, rt});
constexpr std::uint8_t k_y_first = static_cast<std::uint8_t>(~k_x_first);

/// Rules under which a sample on the line of an edge, which rises from left to right by dx, lies right of it.
std::uint8_t right_of_line(std::int64_t dx) {
  std::uint8_t rules = k_right & k_x_first;  // moved sideways: right is right
  if (dx == 0) {
    rules |= k_right & k_y_first;
  } else {
    rules |= (dx > 0 ? k_down : k_up) & k_y_first;
  }
  return rules;
}

/// In samples; rounded up.
constexpr std::int64_t to_samples(std::int64_t fine, int bits) {
  return (fine + (std::int64_t{1} << bits) - 1) >> bits;
}

}  // namespace

Bitmap coverage_masks(std::span<const ScreenVertex> polygon, const Window& window, int subpixel_bits) {
  Bitmap masks(window);
  if (masks.at.empty()) return masks;
  // A sample is inside when the number of edges to its left is odd: each edge is noted where its right side
  // begins, and a sum modulo 2 along the row does the rest.
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    ScreenVertex low = polygon[i], high = polygon[(i + 1) % polygon.size()];
    if (low.y == high.y) continue;
    if (low.y > high.y) std::swap(low, high);
    const std::int64_t dx = std::int64_t{high.x} - low.x, dy = std::int64_t{high.y} - low.y;
    const std::uint8_t on_line = right_of_line(dx);
    const int first = static_cast<int>(std::max<std::int64_t>(to_samples(low.y, subpixel_bits), window.y0));
    const int last = std::min(high.y >> subpixel_bits, window.y1 - 1);
    for (int y = first; y <= last; ++y) {
      const std::int64_t row = std::int64_t{y} << subpixel_bits;
      const auto rules = static_cast<std::uint8_t>((row < high.y ? k_up : 0) | (row > low.y ? k_down : 0));
      const Wide product = Wide{row - low.y} * dx;
      // Nearly everything fits 64 bits, where a division is ten times as fast.
      const bool fits = product >= INT64_MIN && product <= INT64_MAX;
      const std::int64_t quotient =
          fits ? static_cast<std::int64_t>(product) / dy : static_cast<std::int64_t>(product / dy);
      const Wide remainder = product - Wide{quotient} * dy;
      const std::int64_t column = low.x + quotient + (remainder > 0 ? 1 : 0);
      const std::int64_t x = to_samples(column, subpixel_bits);  // first sample not left of the edge
      const bool on_edge = remainder == 0 && x << subpixel_bits == column;
      const std::uint8_t at_x = on_edge ? rules & on_line : rules;
      const auto toggle = [&](std::int64_t where, std::uint8_t what) {
        if (where < window.x1)
          masks.at[masks.window.index(static_cast<int>(std::max<std::int64_t>(where, window.x0)), y)] ^= what;
      };
      toggle(x, at_x);
      toggle(x + 1, rules & static_cast<std::uint8_t>(~at_x));
    }
  }
  for (int y = window.y0; y < window.y1; ++y) {
    std::uint8_t inside = 0;
    for (int x = window.x0; x < window.x1; ++x) {
      std::uint8_t& here = masks.at[window.index(x, y)];
      here = inside ^= here;
    }
  }
  return masks;
}

void mark_boundary(std::span<const ScreenVertex> polygon, Bitmap& bitmap, std::uint8_t value) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ScreenVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
    const std::int64_t steps = std::gcd(dx, dy);
    if (steps == 0) {
      bitmap.set(a.x, a.y, value);
      continue;
    }
    for (std::int64_t k = 0; k <= steps; ++k) {
      bitmap.set(static_cast<int>(a.x + k * (dx / steps)), static_cast<int>(a.y + k * (dy / steps)), value);
    }
  }
}

}  // namespace farop::conformance
