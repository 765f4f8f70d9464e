// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/row_story.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>

namespace farop::conformance_report {
namespace {

__extension__ using Wide = __int128;

/// As a factor or a term of a product: "(−3)" where it is negative.
std::string signed_text(std::int64_t n) {
  return n < 0 ? fmt::format("(\u2212{})", -n) : fmt::format("{}", n);
}

}  // namespace

std::vector<Crossing> crossings(std::span<const ScreenVertex> polygon, int y) {
  std::vector<Crossing> row;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    ScreenVertex low = polygon[k], high = polygon[(k + 1) % polygon.size()];
    if (low.y > high.y) std::swap(low, high);
    if (y < low.y || y >= high.y) continue;
    const std::int64_t dy = std::int64_t{high.y} - low.y;
    const std::int64_t n =
        std::int64_t{low.x} * dy + (std::int64_t{y} - low.y) * (std::int64_t{high.x} - low.x);
    const std::int64_t common = std::gcd(std::llabs(n), dy);
    row.push_back({n / common, dy / common, low, high});
  }
  std::ranges::sort(row, [](const Crossing& a, const Crossing& b) {
    return static_cast<Wide>(a.numerator) * b.denominator < static_cast<Wide>(b.numerator) * a.denominator;
  });
  return row;
}

int crossings_up_to(std::span<const Crossing> row, int x) {
  return static_cast<int>(std::ranges::count_if(
      row, [&](const Crossing& c) { return c.numerator <= std::int64_t{x} * c.denominator; }));
}

EdgeSum edge_sum(const Crossing& edge, int x, int y) {
  const ScreenVertex &a = edge.from, &b = edge.to;
  const std::int64_t dy = std::int64_t{b.y} - a.y, dx = std::int64_t{b.x} - a.x;
  const std::int64_t value = (std::int64_t{x} - a.x) * dy - (std::int64_t{y} - a.y) * dx;
  return {value,
          fmt::format("({} \u2212 {})\u00B7{} \u2212 ({} \u2212 {})\u00B7{} = {}{}", x, signed_text(a.x), dy,
                      y, signed_text(a.y), signed_text(dx), value < 0 ? "\u2212" : "", std::abs(value))};
}

std::string fraction(std::int64_t numerator, std::int64_t denominator) {
  const std::int64_t common = std::gcd(numerator, denominator);
  if (common > 1) numerator /= common, denominator /= common;
  if (denominator == 1) return fmt::format("{}", numerator);
  return fmt::format("{}/{} = {:.2f}", numerator, denominator,
                     static_cast<double>(numerator) / static_cast<double>(denominator));
}

}  // namespace farop::conformance_report
