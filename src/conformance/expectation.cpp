// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/expectation.h"

#include <algorithm>

namespace farop::conformance {

Expectation::Expectation(const Drawing& drawing, ConsistentRule rule)
    : drawing_(&drawing), boundary_(window_of(drawing.frame)) {
  const Window frame = window_of(drawing.frame);
  const std::uint8_t bit = rule_bit(rule);
  first_.assign(frame.samples() + 1, 0);
  polygons_.reserve(drawing.polygons.size());
  for (const TestPolygon& corners : drawing.polygons) {
    ExactPolygon& polygon = polygons_.emplace_back();
    polygon.corners = corners;
    polygon.masks = coverage_masks(corners, bounds(corners, drawing.frame));
    mark_boundary(corners, boundary_, 1);
    for (const Attribute a : k_attributes) {
      const auto i = static_cast<std::size_t>(a);
      polygon.planes[i] = plane_through(corners, a);
      polygon.tolerances[i] = tolerance_of(corners, polygon.planes[i].value_or(Plane{}));
      const auto [low, high] =
          std::ranges::minmax(corners, {}, [a](const ScreenVertex& v) { return value_of(v, a); });
      polygon.ranges[i] = {value_of(low, a), value_of(high, a)};
    }
    const Window& w = polygon.masks.window;
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        if ((polygon.masks.at[w.index(x, y)] & bit) != 0) ++first_[frame.index(x, y) + 1];
      }
    }
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  members_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t p = 0; p < polygons_.size(); ++p) {
    const Window& w = polygons_[p].masks.window;
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        if ((polygons_[p].masks.at[w.index(x, y)] & bit) != 0) members_[next[frame.index(x, y)]++] = p;
      }
    }
  }
}

std::span<const std::uint32_t> Expectation::covering(int x, int y) const {
  const std::size_t i = window_of(drawing_->frame).index(x, y);
  return std::span(members_).subspan(first_[i], first_[i + 1] - first_[i]);
}

namespace {

/// A depth and by how much it may drift, in parts: depth = n / d, drift = parts / (65536 d).
struct DriftingDepth {
  Wide n = 0, d = 1, parts = 0;
};

DriftingDepth depth_of(const ExactPolygon& polygon, int x, int y, bool farthest) {
  const std::optional<Plane>& plane = polygon.plane(Attribute::z);
  // Without a plane every legitimate method stays within the corners' values.
  if (!plane) {
    const auto [low, high] = polygon.range(Attribute::z);
    return {farthest ? high : low, 1, 16384};
  }
  const Rational depth = plane->at(x, y);
  // A constant depth cannot drift; others may by all that the bound leaves beyond 1.
  if (plane->constant()) return {depth.numerator, depth.denominator, 0};
  return {depth.numerator, depth.denominator, 16384 * plane->d + 2 * (plane->a < 0 ? -plane->a : plane->a)};
}

}  // namespace

// In front of a polygon at depth b, drift included, another at f is forced iff b.n / b.d - f.n / f.d >= 1 +
// drifts. That is so for some polygon iff it is for the one whose depth plus drift is smallest: once through
// all is enough.
std::vector<std::uint32_t> Expectation::admissible(int x, int y) const {
  const std::span<const std::uint32_t> all = covering(x, y);
  if (all.size() == 1) return {all[0]};
  DriftingDepth nearest;
  bool known = false;
  for (const std::uint32_t k : all) {
    const DriftingDepth f = depth_of(polygons_[k], x, y, true);
    if (known && (65536 * f.n + f.parts) * nearest.d >= (65536 * nearest.n + nearest.parts) * f.d) continue;
    nearest = f, known = true;
  }
  std::vector<std::uint32_t> left;
  for (const std::uint32_t k : all) {
    const DriftingDepth b = depth_of(polygons_[k], x, y, false);
    const bool hidden =
        (65536 * b.n - b.parts - 65536 * b.d) * nearest.d >= (65536 * nearest.n + nearest.parts) * b.d;
    if (!hidden) left.push_back(k);
  }
  return left;
}

void Expectation::add_boundary_of(FillRule rule) {
  for (const ExactPolygon& polygon : polygons_) {
    const Window w = bounds(polygon.corners, drawing_->frame, 1);
    const Bitmap theirs = rule_coverage(polygon.corners, rule, w);
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        const bool ours = (polygon.masks.get(x, y) & rule_bit(ConsistentRule::lb)) != 0;
        if (ours != (theirs.get(x, y) != 0)) boundary_.set(x, y, 1);
      }
    }
  }
}

int Expectation::nearest(int x, int y) const {
  int best = -1;
  Rational depth;
  for (const std::uint32_t k : covering(x, y)) {
    const std::optional<Plane>& plane = polygons_[k].plane(Attribute::z);
    const Rational here = plane ? plane->at(x, y) : Rational{polygons_[k].range(Attribute::z).first, 1};
    if (best < 0 || here < depth) best = static_cast<int>(k), depth = here;
  }
  return best;
}

}  // namespace farop::conformance
