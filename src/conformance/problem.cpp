// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace farop::conformance {
namespace {

double depth_at(const ExactPolygon& p, int x, int y) {
  const auto& plane = p.plane(Attribute::z);
  return plane ? plane->at(x, y).value() : static_cast<double>(p.range(Attribute::z).first);
}

double mean_depth(const ExactPolygon& p) {
  double sum = 0;
  for (const ScreenVertex& v : p.corners) sum += v.z;
  return sum / static_cast<double>(p.corners.size());
}

Color first_color(const ExactPolygon& p) {
  const ScreenVertex& v = p.corners.front();
  return {static_cast<std::uint8_t>(v.r), static_cast<std::uint8_t>(v.g), static_cast<std::uint8_t>(v.b)};
}

/// Column at which the polygon's span that holds the sample begins, exactly.
double span_start(const ExactPolygon& p, int x, int y) {
  double start = x;
  double best = -1;
  for (std::size_t i = 0; i < p.corners.size(); ++i) {
    ScreenVertex a = p.corners[i], b = p.corners[(i + 1) % p.corners.size()];
    if (a.y > b.y) std::swap(a, b);
    if (y < a.y || y >= b.y) continue;
    const double at = a.x + double{y - a.y + 0.0} * (b.x - a.x) / (b.y - a.y);
    if (at <= x + 1e-9 && at > best) best = at, start = at;
  }
  return start;
}

bool nearly_all(std::uint64_t part, std::uint64_t all) {
  return all > 0 && 100 * part >= 95 * all;
}

}  // namespace

namespace {

/// Who shows in a row when a span is coloured as a whole as soon as one of its pixels is visible, while
/// depths are kept correctly.
std::vector<int> row_by_spans(const Expectation& expected, int y) {
  const int width = expected.drawing().frame.x;
  std::vector<int> owner(static_cast<std::size_t>(width), -1);
  std::vector<double> depth(static_cast<std::size_t>(width), std::numeric_limits<double>::infinity());
  const auto covers = [&](std::uint32_t k, int x) {
    return std::ranges::binary_search(expected.covering(x, y), k);
  };
  for (std::uint32_t k = 0; k < expected.polygons().size(); ++k) {
    const Window& w = expected.polygons()[k].masks.window;
    if (y < w.y0 || y >= w.y1) continue;
    for (int x = w.x0; x < w.x1;) {
      if (!covers(k, x)) {
        ++x;
        continue;
      }
      const int first = x;
      bool visible = false;
      for (; x < w.x1 && covers(k, x); ++x) {
        const double z = depth_at(expected.polygons()[k], x, y);
        double& stored = depth[static_cast<std::size_t>(x)];
        if (z < stored) stored = z, visible = true;
      }
      if (visible) std::fill(owner.begin() + first, owner.begin() + x, static_cast<int>(k));
    }
  }
  return owner;
}

}  // namespace

void DepthStatistics::add(const Expectation& expected, const Framebuffer& picture) {
  const auto& polygons = expected.polygons();
  for (int y = 0; y < picture.height; ++y) {
    std::vector<int> by_spans;
    for (int x = 0; x < picture.width; ++x) {
      const auto covering = expected.covering(x, y);
      if (covering.size() < 2 || expected.admissible(x, y).size() != 1) continue;
      ++decided;
      const Color got = pixel_at(picture, x, y);
      const auto shows = [&](std::uint32_t k) { return first_color(polygons[k]) == got ? 1u : 0u; };
      std::uint32_t nearest = covering[0], farthest = covering[0], careless = covering[0], mean = covering[0];
      double stored = std::numeric_limits<double>::infinity();
      for (const std::uint32_t k : covering) {
        const double z = depth_at(polygons[k], x, y);
        if (z < depth_at(polygons[nearest], x, y)) nearest = k;
        if (z > depth_at(polygons[farthest], x, y)) farthest = k;
        if (z < stored) careless = k;
        stored = z;
        if (mean_depth(polygons[k]) < mean_depth(polygons[mean])) mean = k;
      }
      right += shows(nearest), last_wins += shows(covering.back()), farthest_wins += shows(farthest);
      depth_always_written += shows(careless), mean_depth_wins += shows(mean);
      if (by_spans.empty()) by_spans = row_by_spans(expected, y);
      const int span = by_spans[static_cast<std::size_t>(x)];
      whole_span_colored += span >= 0 ? shows(static_cast<std::uint32_t>(span)) : 0;
      if (shows(nearest) != 0 || y == 0) continue;
      const int below = expected.nearest(x, y - 1);
      const auto shows_below = [&](int k) {
        return k >= 0 && first_color(polygons[static_cast<std::size_t>(k)]) == pixel_at(picture, x, y - 1);
      };
      if (!shows_below(below)) continue;
      ++wrong_begins;
      kept_from_below += shows(static_cast<std::uint32_t>(below));
    }
  }
}

void DepthStatistics::add(const DepthStatistics& o) {
  decided += o.decided, right += o.right, last_wins += o.last_wins, farthest_wins += o.farthest_wins;
  depth_always_written += o.depth_always_written, mean_depth_wins += o.mean_depth_wins;
  whole_span_colored += o.whole_span_colored, wrong_begins += o.wrong_begins,
      kept_from_below += o.kept_from_below;
}

DepthStatistics::Name DepthStatistics::name() const {
  const auto fits = [this](std::uint64_t part) { return 100 * part >= 98 * decided && part > right; };
  if (fits(last_wins))
    return {"depth.none", "the polygon drawn last wins everywhere",
            "there is no depth test: draw a pixel only where it is nearer than what is there"};
  if (fits(farthest_wins)) return {"depth.inverted", "the farther polygon wins", "smaller z is nearer"};
  if (fits(depth_always_written))
    return {"depth.stale", "a polygon that loses the depth test leaves its depth behind",
            "write depth and colour together, and only where the test is won"};
  if (fits(mean_depth_wins))
    return {"depth.order",
            "the polygon of smaller mean depth wins everywhere, not the one that is nearer at the pixel",
            "no order of whole polygons is right: compare depths at every pixel"};
  if (fits(whole_span_colored))
    return {"colour.stale", "a whole span is coloured as soon as one of its pixels is visible",
            "write depth and colour together, and only where the depth test is won"};
  if (nearly_all(kept_from_below, wrong_begins) && wrong_begins > 20)
    return {"depth.stale", "what was visible in the row below is kept although something else is nearer",
            "compare the depths in every row anew"};
  return {"depth.wrong", "the wrong polygon is in front", "compare the depths at this very pixel"};
}

void ColorStatistics::add(const Expectation& expected, const std::vector<WrongSample>& samples) {
  for (const WrongSample& s : samples) {
    if (s.kind != Wrong::color || s.expected_owner < 0) continue;
    const ExactPolygon& p = expected.polygons()[static_cast<std::size_t>(s.expected_owner)];
    // Where several methods are right there is nothing exact to compare with.
    if (!p.plane(Attribute::r) || !p.plane(Attribute::g) || !p.plane(Attribute::b)) continue;
    ++wrong;
    const double scale = 255.0 / (expected.drawing().frame.color - 1);
    if (flat.size() < p.corners.size()) flat.resize(p.corners.size());
    for (std::size_t k = 0; k < p.corners.size(); ++k) {
      bool same = true;
      for (std::size_t c = 0; c < 3; ++c)
        same = same &&
               std::abs(scale * static_cast<double>(value_of(p.corners[k], k_channels[c])) - s.got[c]) <= 1;
      if (same) ++flat[k];
    }
    const double start = span_start(p, s.x, s.y), late = std::ceil(start - 1e-9) - start;
    bool starts = true, outside = false, tiny = true, mixed = true;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& plane = p.plane(k_channels[c]);
      const auto [low, high] = p.range(k_channels[c]);
      const double bound = p.tolerance(k_channels[c]).bound.value();
      if (s.got[c] < scale * (static_cast<double>(low) - bound) ||
          s.got[c] > scale * (static_cast<double>(high) + bound))
        outside = true;
      if (!plane) {
        starts = mixed = tiny = false;
        continue;
      }
      const double value = plane->at(s.x, s.y).value();
      const double slope = static_cast<double>(plane->a) / static_cast<double>(plane->d);
      if (std::abs(scale * (value - late * slope) - s.got[c]) > 1.3 * scale) starts = false;
      if (std::abs(scale * value - s.got[c]) > 4) tiny = false;
      bool other = std::abs(scale * value - s.got[c]) <= 1.3 * scale;
      for (const Attribute a : k_channels) {
        if (!p.plane(a)) continue;
        const Plane& q = *p.plane(a);
        const double step = static_cast<double>(q.a) / static_cast<double>(q.d);
        // Right at the crossing or at the first pixel, then with the other's steps; a byte may wrap around.
        for (const double from : {start, std::ceil(start - 1e-9)}) {
          const double stepped = scale * (value + (s.x - from) * (step - slope));
          other = other || std::abs(std::remainder(stepped - s.got[c], 256.0)) <= 1.3 * scale ||
                  std::abs(std::clamp(stepped, 0.0, 255.0) - s.got[c]) <= 1.3 * scale;
        }
        other = other || std::abs(scale * q.at(s.x, s.y).value() - s.got[c]) <= 1.3 * scale;
      }
      mixed = mixed && other;
    }
    start_sample += starts ? 1 : 0, channels += mixed ? 1 : 0, out_of_range += outside ? 1 : 0,
        small += tiny ? 1 : 0;
  }
}

void ColorStatistics::add(const ColorStatistics& o) {
  wrong += o.wrong, start_sample += o.start_sample, channels += o.channels, out_of_range += o.out_of_range,
      small += o.small;
  if (flat.size() < o.flat.size()) flat.resize(o.flat.size());
  for (std::size_t i = 0; i < o.flat.size(); ++i) flat[i] += o.flat[i];
}

DepthStatistics::Name ColorStatistics::name() const {
  for (std::size_t k = 0; k < flat.size(); ++k) {
    if (nearly_all(flat[k], wrong))
      return {"colour.flat", "all pixels of a polygon have the colour of vertex " + std::to_string(k),
              "interpolate: every pixel has a colour of its own"};
  }
  if (nearly_all(start_sample, wrong))
    return {"colour.start-sample", "the first pixel of a span gets the colour at the edge crossing",
            "correct the first value by (ceil(xL) - xL) times the slope"};
  if (nearly_all(channels, wrong))
    return {"colour.channels", "a channel is interpolated with another channel's step or values",
            "look for a mix-up of r, g and b"};
  if (out_of_range > 0)
    return {"colour.range", "colours leave the range of the polygon's corners",
            "you extrapolate beyond an edge, or a value wraps around (255 + 1 = 0)"};
  if (nearly_all(small, wrong))
    return {"colour.drift", "small errors add up", "keep more fractional bits, or use double"};
  return {"colour.wrong", "colours are wrong", "the smallest example is below"};
}

DepthStatistics::Name name_depths(const Expectation& expected, const std::vector<MeasuredDepth>& wrong) {
  std::uint64_t start_sample = 0, half = 0, swapped = 0, negated = 0, small = 0;
  for (const MeasuredDepth& m : wrong) {
    const ExactPolygon& p = expected.polygons()[m.owner];
    const auto& plane = p.plane(Attribute::z);
    if (!plane) continue;
    const double a = static_cast<double>(plane->a) / static_cast<double>(plane->d),
                 b = static_cast<double>(plane->b) / static_cast<double>(plane->d);
    const double value = plane->at(m.x, m.y).value(), out = static_cast<double>(m.farthest_win) + 0.5;
    const auto near = [&](double guess) { return std::abs(guess - out) <= 1.8 + 1e-6 * std::abs(guess); };
    const double start = span_start(p, m.x, m.y);
    start_sample += near(value - (std::ceil(start - 1e-9) - start) * a) ? 1 : 0;
    half += near(value + a / 2 + b / 2) || near(value - a / 2 - b / 2) || near(value + a / 2) ||
                    near(value - a / 2)
                ? 1
                : 0;
    bool swap = false, minus = false;
    for (const ScreenVertex& v : p.corners) {
      const double dx = m.x - v.x, dy = m.y - v.y;
      swap = swap || near(v.z + b * dx + a * dy);
      minus =
          minus || near(v.z - a * dx - b * dy) || near(v.z - a * dx + b * dy) || near(v.z + a * dx - b * dy);
    }
    swapped += swap ? 1 : 0, negated += minus ? 1 : 0;
    const double size = static_cast<double>(expected.drawing().frame.x + expected.drawing().frame.y);
    small += std::abs(value - out) <= 2 + size / 8 ? 1 : 0;
  }
  const std::uint64_t all = wrong.size();
  if (nearly_all(start_sample, all) || nearly_all(half, all))
    return {"depth.start-sample", "depth is taken at the edge crossing, not at the pixel",
            "correct the first value by (ceil(xL) - xL) * dz/dx"};
  if (nearly_all(swapped, all))
    return {"depth.slopes", "dz/dx and dz/dy are exchanged", "the plane's slopes are swapped"};
  if (nearly_all(negated, all))
    return {"depth.slopes", "a slope of the plane has the wrong sign",
            "look at the signs of dz/dx and dz/dy"};
  if (nearly_all(small, all))
    return {"depth.drift", "small errors of depth add up along rows or columns",
            "keep more fractional bits, or use double"};
  return {"depth.wrong", "depths are wrong", "the smallest example is below"};
}

}  // namespace farop::conformance
