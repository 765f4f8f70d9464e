// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/attribute.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace farop::conformance {

std::int64_t value_of(const ScreenVertex& v, Attribute attribute) {
  switch (attribute) {
    case Attribute::z:
      return v.z;
    case Attribute::r:
      return v.r;
    case Attribute::g:
      return v.g;
    case Attribute::b:
      break;
  }
  return v.b;
}

void set_value(ScreenVertex& v, Attribute attribute, std::int64_t value) {
  switch (attribute) {
    case Attribute::z:
      v.z = static_cast<std::int32_t>(value);
      return;
    case Attribute::r:
      v.r = static_cast<std::uint16_t>(value);
      return;
    case Attribute::g:
      v.g = static_cast<std::uint16_t>(value);
      return;
    case Attribute::b:
      v.b = static_cast<std::uint16_t>(value);
  }
}

Rational absolute(const Rational& a) {
  return {a.numerator < 0 ? -a.numerator : a.numerator, a.denominator};
}

std::optional<Plane> plane_through(std::span<const ScreenVertex> polygon, Attribute attribute) {
  if (polygon.empty()) return std::nullopt;
  const ScreenVertex& o = polygon[0];
  const std::int64_t v0 = value_of(o, attribute);
  const bool constant =
      std::ranges::all_of(polygon, [&](const ScreenVertex& v) { return value_of(v, attribute) == v0; });
  if (constant) return Plane{0, 0, v0, 1};
  // A second corner elsewhere, then a third one off their line.
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    const Wide x1 = polygon[i].x - Wide{o.x}, y1 = polygon[i].y - Wide{o.y};
    if (x1 == 0 && y1 == 0) continue;
    for (std::size_t k = i + 1; k < polygon.size(); ++k) {
      const Wide x2 = polygon[k].x - Wide{o.x}, y2 = polygon[k].y - Wide{o.y};
      Wide d = x1 * y2 - x2 * y1;
      if (d == 0) continue;
      const Wide v1 = value_of(polygon[i], attribute) - v0, v2 = value_of(polygon[k], attribute) - v0;
      Wide a = v1 * y2 - v2 * y1, b = v2 * x1 - v1 * x2;
      if (d < 0) a = -a, b = -b, d = -d;
      const Plane plane{a, b, v0 * d - a * o.x - b * o.y, d};
      const bool all = std::ranges::all_of(polygon, [&](const ScreenVertex& v) {
        return plane.at(v.x, v.y) == Rational{value_of(v, attribute), 1};
      });
      return all ? std::optional(plane) : std::nullopt;
    }
    return std::nullopt;  // all on one line
  }
  return std::nullopt;
}

Tolerance tolerance_of(std::span<const ScreenVertex> polygon, const Plane& plane) {
  const auto [left, right] = std::ranges::minmax(polygon, {}, &ScreenVertex::x);
  const auto [bottom, top] = std::ranges::minmax(polygon, {}, &ScreenVertex::y);
  const Wide rows = Wide{top.y} - bottom.y, columns = Wide{right.x} - left.x;
  const Wide slope = plane.a < 0 ? -plane.a : plane.a;  // over d
  constexpr Wide one = 65536;
  return {{(one + rows + columns + 2) * plane.d + 2 * slope, one * plane.d},
          {(one + one / 4) * plane.d + 2 * slope, one * plane.d}};
}

namespace {

struct ValuedCrossing {
  Rational x, value;
};

}  // namespace

std::optional<Rational> scan_line_value(std::span<const ScreenVertex> polygon, Attribute attribute, int x,
                                        int y) {
  std::vector<ValuedCrossing> crossings;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    ScreenVertex a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if (a.y > b.y) std::swap(a, b);
    if (y < a.y || y >= b.y) continue;
    const Wide dy = Wide{b.y} - a.y, t = Wide{y} - a.y;
    crossings.push_back(
        {{a.x * dy + t * (Wide{b.x} - a.x), dy},
         {value_of(a, attribute) * dy + t * (value_of(b, attribute) - value_of(a, attribute)), dy}});
  }
  std::ranges::sort(crossings, {}, [](const ValuedCrossing& c) { return c.x.value(); });
  const Rational here{x, 1};
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    const ValuedCrossing &left = crossings[i], &right = crossings[i + 1];
    if (!(left.x <= here) || !(here < right.x)) continue;
    const Rational width = right.x - left.x, part = here - left.x, rise = right.value - left.value;
    // left + rise * part / width
    return left.value + Rational{rise.numerator * part.numerator * width.denominator,
                                 rise.denominator * part.denominator * width.numerator};
  }
  return std::nullopt;
}

}  // namespace farop::conformance
