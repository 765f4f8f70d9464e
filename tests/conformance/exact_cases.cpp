// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/exact_cases.h"

namespace farop::test {
namespace {

/// Edges between `corners` (times `scale`) that a half-line from (x, y) to the left crosses.
bool odd_to_the_left(const Corners& corners, Int128 scale, Int128 x, Int128 y) {
  bool odd = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ScreenVertex &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const ScreenVertex &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
    if (y <= low.y * scale || y > high.y * scale) continue;
    // Twice the area of low, high, (x, y); the sign says on which side.
    const Int128 side =
        Int128{high.x - low.x} * (y - low.y * scale) - Int128{high.y - low.y} * (x - low.x * scale);
    if (side < 0) odd = !odd;
  }
  return odd;
}

bool on_segment(const ScreenVertex& a, const ScreenVertex& b, int x, int y) {
  const std::int64_t side = std::int64_t{b.x - a.x} * (y - a.y) - std::int64_t{b.y - a.y} * (x - a.x);
  return side == 0 && std::min(a.x, b.x) <= x && x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= y &&
         y <= std::max(a.y, b.y);
}

bool on_boundary(const Corners& corners, int x, int y) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (on_segment(corners[i], corners[(i + 1) % corners.size()], x, y)) return true;
  }
  return false;
}

Coverage with_boundary(const Corners& corners, int width, int height, bool drawn) {
  Coverage coverage = moved_coverage(corners, k_lb, width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (on_boundary(corners, x, y)) coverage[static_cast<std::size_t>(y * width + x)] = drawn ? 1 : 0;
    }
  }
  return coverage;
}

}  // namespace

Coverage moved_coverage(const Corners& corners, const MovedSample& rule, int width, int height) {
  // Slopes are below 1000 and crossings at least 1/1000 apart: 2^-40 and 2^-20 of a pixel are tiny enough.
  const Int128 scale = Int128{1} << 40, large = Int128{1} << 20;
  Coverage coverage;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Int128 sample_x = x * scale + rule.x * (rule.x_dominates ? large : 1);
      const Int128 sample_y = y * scale + rule.y * (rule.x_dominates ? 1 : large);
      coverage.push_back(odd_to_the_left(corners, scale, sample_x, sample_y) ? 1 : 0);
    }
  }
  return coverage;
}

Coverage closed_coverage(const Corners& corners, int width, int height) {
  return with_boundary(corners, width, height, true);
}

Coverage open_coverage(const Corners& corners, int width, int height) {
  return with_boundary(corners, width, height, false);
}

std::optional<ExactAffine> ExactAffine::through(const Corners& corners, Attribute attribute) {
  const ScreenVertex& p = corners[0];
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const ScreenVertex &q = corners[i], &r = corners[i + 1];
    const std::int64_t area = std::int64_t{q.x - p.x} * (r.y - p.y) - std::int64_t{q.y - p.y} * (r.x - p.x);
    if (area == 0) continue;
    const Int128 sign = area > 0 ? 1 : -1;
    const std::int64_t u = value_of(q, attribute) - value_of(p, attribute);
    const std::int64_t v = value_of(r, attribute) - value_of(p, attribute);
    ExactAffine f;
    f.denominator = area * sign;
    f.a = sign * (Int128{u} * (r.y - p.y) - Int128{v} * (q.y - p.y));
    f.b = sign * (Int128{v} * (q.x - p.x) - Int128{u} * (r.x - p.x));
    f.c = value_of(p, attribute) * f.denominator - f.a * p.x - f.b * p.y;
    return f;
  }
  return std::nullopt;
}

double ExactAffine::error(std::int64_t out, int x, int y) const {
  return static_cast<double>(out * denominator - (a * x + b * y + c)) / static_cast<double>(denominator);
}

std::string text_of(const Corners& corners) {
  std::string text;
  for (const ScreenVertex& v : corners) {
    text += "(" + std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z) + ")";
  }
  return text;
}

}  // namespace farop::test
