// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/fill_rules.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <utility>
#include <vector>

#include "conformance/wide.h"

namespace farop::conformance {
namespace {

/// Where an edge crosses a row: x = numerator / denominator.
struct Crossing {
  std::int64_t numerator = 0, denominator = 1;

  int floor() const { return static_cast<int>(floor_quotient(numerator, denominator)); }
  int ceil() const { return static_cast<int>(ceil_quotient(numerator, denominator)); }
  int nearest() const {
    return static_cast<int>(floor_quotient(Wide{2} * numerator + denominator, Wide{2} * denominator));
  }
  friend bool operator<(const Crossing& a, const Crossing& b) {
    return Wide{a.numerator} * b.denominator < Wide{b.numerator} * a.denominator;
  }
};

struct Edge {
  ScreenVertex low, high;
  int first_row = 0, last_row = 0;  ///< rows in which it lives, both included

  Crossing at(int y) const {
    const std::int64_t dy = std::int64_t{high.y} - low.y;
    return {low.x * dy + (std::int64_t{y} - low.y) * (std::int64_t{high.x} - low.x), dy};
  }
};

/// Edges that are not horizontal, alive for ymin <= y < ymax.
std::vector<Edge> edges_of(std::span<const ScreenVertex> polygon) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    ScreenVertex a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if (a.y == b.y) continue;
    if (a.y > b.y) std::swap(a, b);
    edges.push_back({a, b, a.y, b.y - 1});
  }
  return edges;
}

void fill_row(Bitmap& bitmap, int y, int first, int last) {
  for (int x = std::max(first, bitmap.window.x0); x <= std::min(last, bitmap.window.x1 - 1); ++x)
    bitmap.set(x, y, 1);
}

using SpanEnds = std::function<std::pair<int, int>(const Crossing& left, const Crossing& right)>;

/// First and last sample of a span under lb.
std::pair<int, int> half_open(const Crossing& left, const Crossing& right) {
  return {left.ceil(), right.ceil() - 1};
}

std::vector<Crossing> crossings_of(const std::vector<Edge>& edges, int y) {
  std::vector<Crossing> crossings;
  for (const Edge& edge : edges) {
    if (edge.first_row <= y && y <= edge.last_row) crossings.push_back(edge.at(y));
  }
  std::ranges::sort(crossings, std::less<>{});
  return crossings;
}

void fill_pairs(Bitmap& bitmap, int y, const std::vector<Crossing>& crossings, const SpanEnds& ends,
                bool open_end) {
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    const auto [first, last] = ends(crossings[i], crossings[i + 1]);
    fill_row(bitmap, y, first, last);
  }
  if (crossings.size() % 2 == 1 && open_end)
    fill_row(bitmap, y, crossings.back().ceil(), bitmap.window.x1 - 1);
}

Bitmap filled_rows(const std::vector<Edge>& edges, const Window& window, const SpanEnds& ends,
                   bool open_end = false) {
  Bitmap bitmap(window);
  for (int y = window.y0; y < window.y1; ++y) fill_pairs(bitmap, y, crossings_of(edges, y), ends, open_end);
  return bitmap;
}

/// Corners without immediate repetitions.
TestPolygon without_repeats(std::span<const ScreenVertex> polygon) {
  TestPolygon kept;
  for (const ScreenVertex& v : polygon) {
    if (kept.empty() || kept.back().x != v.x || kept.back().y != v.y) kept.push_back(v);
  }
  while (kept.size() > 1 && kept.back().x == kept.front().x && kept.back().y == kept.front().y)
    kept.pop_back();
  return kept;
}

void draw_minima(std::span<const ScreenVertex> polygon, Bitmap& bitmap) {
  const TestPolygon ring = without_repeats(polygon);
  for (std::size_t i = 0; i < ring.size() && ring.size() > 2; ++i) {
    const ScreenVertex &before = ring[(i + ring.size() - 1) % ring.size()],
                       &after = ring[(i + 1) % ring.size()];
    if (before.y > ring[i].y && after.y > ring[i].y) bitmap.set(ring[i].x, ring[i].y, 1);
  }
}

/// Bresenham's line, both ends, from the lower end (of equals the left one).
void draw_line(ScreenVertex a, ScreenVertex b, const std::function<void(int, int)>& plot) {
  if (b.y < a.y || (b.y == a.y && b.x < a.x)) std::swap(a, b);
  const int dx = std::abs(b.x - a.x), dy = b.y - a.y, step = b.x < a.x ? -1 : 1;
  int error = dx - dy, x = a.x, y = a.y;
  while (true) {
    plot(x, y);
    if (x == b.x && y == b.y) return;
    const int twice = 2 * error;
    if (twice > -dy) error -= dy, x += step;
    if (twice < dx) error += dx, ++y;
  }
}

Bitmap outline_coverage(std::span<const ScreenVertex> polygon, const Window& window) {
  Bitmap bitmap(window);
  std::vector<std::pair<int, int>> row(static_cast<std::size_t>(window.height()), {INT32_MAX, INT32_MIN});
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    draw_line(polygon[i], polygon[(i + 1) % polygon.size()], [&](int x, int y) {
      if (y < window.y0 || y >= window.y1) return;
      auto& [left, right] = row[static_cast<std::size_t>(y - window.y0)];
      left = std::min(left, x), right = std::max(right, x);
    });
  }
  for (int y = window.y0; y < window.y1; ++y) {
    const auto& [left, right] = row[static_cast<std::size_t>(y - window.y0)];
    if (left <= right) fill_row(bitmap, y, left, right);
  }
  return bitmap;
}

Bitmap from_mask(std::span<const ScreenVertex> polygon, const Window& window, std::uint8_t bit) {
  Bitmap bitmap = coverage_masks(polygon, window);
  for (std::uint8_t& b : bitmap.at) b = (b & bit) != 0 ? 1 : 0;
  return bitmap;
}

Bitmap half_centre_coverage(std::span<const ScreenVertex> polygon, const Window& window) {
  TestPolygon doubled(polygon.begin(), polygon.end());
  for (ScreenVertex& v : doubled) v.x *= 2, v.y *= 2;
  const Bitmap fine = coverage_masks(doubled, {2 * window.x0, 2 * window.y0, 2 * window.x1, 2 * window.y1});
  Bitmap bitmap(window);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x)
      bitmap.set(x, y, (fine.get(2 * x + 1, 2 * y + 1) & rule_bit(ConsistentRule::lb)) != 0 ? 1 : 0);
  }
  return bitmap;
}

TestPolygon hull_of(std::span<const ScreenVertex> polygon) {
  TestPolygon points(polygon.begin(), polygon.end());
  std::ranges::sort(points,
                    [](const auto& a, const auto& b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
  TestPolygon hull;
  // Monotone chain: the lower half, then the upper one.
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = hull.size();
    for (const ScreenVertex& p : points) {
      while (hull.size() >= start + 2) {
        const ScreenVertex &a = hull[hull.size() - 2], &b = hull.back();
        const std::int64_t turn =
            std::int64_t{b.x - a.x} * (p.y - a.y) - std::int64_t{b.y - a.y} * (p.x - a.x);
        if (turn > 0) break;
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

/// Rows in which both edges of a corner live, by what kind of corner it is.
Bitmap vertex_slip(std::span<const ScreenVertex> polygon, Slip slip, bool open_end, const Window& window) {
  const TestPolygon ring = without_repeats(polygon);
  std::vector<Edge> edges = edges_of(ring);
  for (std::size_t i = 0; i < ring.size() && ring.size() > 2; ++i) {
    const ScreenVertex &before = ring[(i + ring.size() - 1) % ring.size()], &here = ring[i],
                       &after = ring[(i + 1) % ring.size()];
    const bool through = (before.y < here.y && here.y < after.y) || (before.y > here.y && here.y > after.y);
    const bool maximum = before.y < here.y && after.y < here.y;
    const bool counts = slip == Slip::pass_through_twice ? through : maximum;
    if (!counts) continue;
    // One more crossing in the row of the corner.
    edges.push_back({here, {here.x, here.y + 1}, here.y, here.y});
  }
  return filled_rows(edges, window, half_open, open_end);
}

constexpr std::array<std::string_view, k_fill_rules> k_rule_names = {
    "lb",   "lt",          "rb",     "rt",    "lb'",   "lt'",     "rb'",   "rt'",         "closed",
    "open", "closed-span", "lb+min", "touch", "round", "round-1", "trunc", "half-centre", "outline"};

constexpr std::array<SlipFacts, k_slips> k_slip_facts = {{
    {"cov.row-missing", "an edge is removed one row before its last",
     "an edge lives for ymin <= y < ymax: remove it when y reaches ymax, not before"},
    {"cov.row-missing", "an edge is inserted one row late",
     "an edge lives for ymin <= y < ymax: insert it in row ymin, before that row is filled"},
    {"cov.row-extra", "an edge is removed one row late",
     "the top row does not belong: an edge lives for ymin <= y < ymax"},
    {"cov.leak", "a vertex between an edge below and an edge above is counted twice",
     "give every edge the rows ymin <= y < ymax: then such a vertex counts once"},
    {"cov.leak", "a local maximum is counted once",
     "give every edge the rows ymin <= y < ymax: then a maximum counts not at all"},
    {"cov.horizontal", "horizontal edges are counted as crossings",
     "leave horizontal edges out: their neighbours draw them"},
    {"cov.concave", "only the first and the last crossing of a row are used",
     "sort all crossings of a row and fill between the first and second, the third and fourth ..."},
    {"cov.concave", "the convex hull is filled",
     "concave polygons are polygons too: fill between pairs of crossings"},
    {"cov.missing", "the edge from the last to the first vertex is left out",
     "the ring is closed: its last edge leads from the last vertex to the first"},
    {"cov.missing", "a repeated vertex ends the polygon",
     "an edge of length zero is legal: skip it and go on with the next"},
    {"cov.sliver", "polygons of fewer than two pixels are dropped",
     "thin polygons are legal: draw whatever samples they cover"},
    {"cov.order", "only clockwise polygons are drawn", "front faces run counter-clockwise; draw both"},
    {"cov.order", "only counter-clockwise polygons are drawn",
     "go by parity, not by the turn: polygons that run clockwise are drawn too"},
}};

}  // namespace

std::string_view rule_name(FillRule rule) {
  return k_rule_names[static_cast<std::size_t>(rule)];
}

const SlipFacts& slip_facts(Slip slip) {
  return k_slip_facts[static_cast<std::size_t>(slip)];
}

Bitmap rule_coverage(std::span<const ScreenVertex> polygon, FillRule rule, const Window& window) {
  const auto spans = [&](const SpanEnds& ends) { return filled_rows(edges_of(polygon), window, ends); };
  switch (rule) {
    case FillRule::closed: {
      Bitmap bitmap = from_mask(polygon, window, 0xFF);
      mark_boundary(polygon, bitmap, 1);
      return bitmap;
    }
    case FillRule::open: {
      Bitmap bitmap = from_mask(polygon, window, 0xFF);
      mark_boundary(polygon, bitmap, 0);
      return bitmap;
    }
    case FillRule::closed_span:
      return spans([](const Crossing& l, const Crossing& r) { return std::pair(l.ceil(), r.floor()); });
    case FillRule::lb_min: {
      Bitmap bitmap = from_mask(polygon, window, rule_bit(ConsistentRule::lb));
      draw_minima(polygon, bitmap);
      return bitmap;
    }
    case FillRule::touch:
      return spans([](const Crossing& l, const Crossing& r) { return std::pair(l.floor(), r.floor()); });
    case FillRule::round:
      return spans([](const Crossing& l, const Crossing& r) { return std::pair(l.nearest(), r.nearest()); });
    case FillRule::round_less:
      return spans(
          [](const Crossing& l, const Crossing& r) { return std::pair(l.nearest(), r.nearest() - 1); });
    case FillRule::trunc:
      return spans([](const Crossing& l, const Crossing& r) { return std::pair(l.floor(), r.floor() - 1); });
    case FillRule::half_centre:
      return half_centre_coverage(polygon, window);
    case FillRule::outline:
      return outline_coverage(polygon, window);
    default:
      return from_mask(polygon, window, static_cast<std::uint8_t>(1u << static_cast<unsigned>(rule)));
  }
}

Bitmap slip_coverage(std::span<const ScreenVertex> polygon, Slip slip, bool open_end, const Window& window) {
  std::vector<Edge> edges = edges_of(polygon);
  switch (slip) {
    case Slip::last_row_dropped:
      for (Edge& e : edges) --e.last_row;
      break;
    case Slip::first_row_late:
      for (Edge& e : edges) ++e.first_row;
      break;
    case Slip::last_row_kept:
      for (Edge& e : edges) ++e.last_row;
      break;
    case Slip::pass_through_twice:
    case Slip::maximum_once:
      return vertex_slip(polygon, slip, open_end, window);
    case Slip::horizontal_counted:
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const ScreenVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if (a.y == b.y && a.x != b.x) edges.push_back({a, {a.x, a.y + 1}, a.y, a.y});
      }
      break;
    case Slip::outermost_crossings: {
      Bitmap bitmap(window);
      for (int y = window.y0; y < window.y1; ++y) {
        const std::vector<Crossing> crossings = crossings_of(edges, y);
        if (crossings.size() < 2) continue;
        const auto [first, last] = half_open(crossings.front(), crossings.back());
        fill_row(bitmap, y, first, last);
      }
      return bitmap;
    }
    case Slip::convex_hull:
      return from_mask(hull_of(polygon), window, rule_bit(ConsistentRule::lb));
    case Slip::closing_edge_missing:
      if (polygon.back().y != polygon.front().y) edges.pop_back();
      break;
    case Slip::repeated_vertex_ends: {
      std::size_t count = 1;
      while (count < polygon.size() &&
             (polygon[count].x != polygon[count - 1].x || polygon[count].y != polygon[count - 1].y))
        ++count;
      // Some stop before the corner that is repeated, some behind it.
      if (open_end && count < polygon.size()) --count;
      return from_mask(polygon.first(count), window, rule_bit(ConsistentRule::lb));
    }
    case Slip::thin_dropped: {
      Bitmap bitmap = from_mask(polygon, window, rule_bit(ConsistentRule::lb));
      if (std::ranges::count(bitmap.at, 1) < 2) std::ranges::fill(bitmap.at, std::uint8_t{0});
      return bitmap;
    }
    case Slip::counter_clockwise_lost:
    case Slip::clockwise_lost: {
      Bitmap bitmap = from_mask(polygon, window, rule_bit(ConsistentRule::lb));
      if ((twice_area(polygon) > 0) == (slip == Slip::counter_clockwise_lost))
        std::ranges::fill(bitmap.at, std::uint8_t{0});
      return bitmap;
    }
  }
  return filled_rows(edges, window, half_open, open_end);
}

}  // namespace farop::conformance
