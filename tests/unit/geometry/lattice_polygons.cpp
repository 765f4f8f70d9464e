// SPDX-License-Identifier: GPL-3.0-or-later
#include "unit/geometry/lattice_polygons.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

namespace farop::lattice {
namespace {

int turn(const Point& a, const Point& b, const Point& c) {
  const std::int64_t area = doubled_area(a, b, c);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

/// p on the closed segment a b.
bool on_segment(const Point& a, const Point& b, const Point& p) {
  return turn(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
         std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

/// Whether two closed segments have a point in common.
bool meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  if (on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b)) return true;
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

Point random_point(Random& random, std::int64_t size) {
  const std::int64_t x = below(random, size);
  return {x, below(random, size)};
}

using Corners = std::array<Point, 3>;

/// Whether the open inside of a counter-clockwise triangle is free of a convex set, given by its corners:
/// one of the triangle's sides has them all beyond it, or one of the set's sides has all of the triangle
/// beyond it.
bool inside_is_free_of(const Corners& t, const std::vector<Point>& convex) {
  const auto separates = [](const Point& a, const Point& b, const auto& corners) {
    return std::ranges::all_of(corners, [&](const Point& p) { return turn(a, b, p) <= 0; });
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (separates(t[i], t[(i + 1) % 3], convex)) return true;
  }
  for (std::size_t i = 0; i < convex.size(); ++i) {
    if (separates(convex[i], convex[(i + 1) % convex.size()], t)) return true;
  }
  return false;
}

/// Grows a ring around triangles that do not overlap, and around bare segments that touch nothing when they
/// are made.
class DiscGrower {
 public:
  DiscGrower(Random& random, std::int64_t size) : random_(random), size_(size) {
    while (true) {
      const Corners t{pick(), pick(), pick()};
      if (turn(t[0], t[1], t[2]) <= 0) continue;
      ring_.assign(t.begin(), t.end());
      triangles_.push_back(t);
      return;
    }
  }

  const Polygon& ring() const { return ring_; }

  void try_triangle() {
    const std::size_t i = pick_corner();
    const Point a = ring_[i];
    const Point b = ring_[(i + 1) % ring_.size()];
    const Corners t{a, pick(), b};
    if (turn(t[0], t[1], t[2]) <= 0) return;
    for (const Corners& other : triangles_) {
      if (!inside_is_free_of(t, {other.begin(), other.end()})) return;
    }
    const bool is_bare = std::ranges::any_of(
        bare_, [&](const Segment& s) { return s == Segment(a, b) || s == Segment(b, a); });
    for (const Segment& s : bare_) {
      if (!inside_is_free_of(t, {s.first, s.second})) return;
      // A segment along the edge would get between the triangle and what it is attached to.
      if (!is_bare && turn(a, b, s.first) == 0 && turn(a, b, s.second) == 0 && overlap(a, b, s)) return;
      if (!is_bare && (inside_of_edge(a, b, s.first) || inside_of_edge(a, b, s.second))) return;
    }
    if (is_bare)
      std::erase_if(bare_, [&](const Segment& s) { return s == Segment(a, b) || s == Segment(b, a); });
    triangles_.push_back(t);
    ring_.insert(ring_.begin() + static_cast<std::ptrdiff_t>(i) + 1, t[1]);
  }

  void try_antenna() {
    const std::size_t root = pick_corner();
    const Point from = ring_[root];
    const Point tip = pick();
    if (tip == from) return;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const Point& a = ring_[i];
      const Point& b = ring_[(i + 1) % ring_.size()];
      if (on_segment(a, b, tip)) return;
      if (a != from && on_segment(from, tip, a)) return;
      if (a != from && b != from && meet(a, b, from, tip)) return;
    }
    for (const Corners& t : triangles_) {
      if (!inside_is_free_of(t, {from, tip})) return;
    }
    if (!belongs_to_visit(root, tip)) return;
    ring_.insert(ring_.begin() + static_cast<std::ptrdiff_t>(root) + 1, {tip, from});
    bare_.emplace_back(from, tip);
  }

 private:
  using Segment = std::pair<Point, Point>;

  Point pick() { return random_point(random_, size_); }
  std::size_t pick_corner() {
    return static_cast<std::size_t>(below(random_, static_cast<std::int64_t>(ring_.size())));
  }

  static bool inside_of_edge(const Point& a, const Point& b, const Point& p) {
    return p != a && p != b && on_segment(a, b, p);
  }
  static bool overlap(const Point& a, const Point& b, const Segment& s) {
    const auto project = [&](const Point& p) {
      return (p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y);
    };
    const auto [low, high] = std::minmax({project(s.first), project(s.second)});
    return low < project(b) && high > 0;
  }

  /// The ring may pass a point several times. A new segment there has to start between the right
  /// neighbours: going counter-clockwise from it, the first edge met must be the one that leaves the root,
  /// and no other beside it.
  bool belongs_to_visit(std::size_t root, const Point& tip) const {
    const Point& at = ring_[root];
    const auto comes_first = [&](const Point& p, const Point& q) {  // counter-clockwise from the new segment
      const auto half = [&](const Point& r) { return turn(at, tip, r) > 0 ? 0 : 1; };
      if (half(p) != half(q)) return half(p) < half(q);
      return turn(at, p, q) > 0;
    };
    const std::size_t n = ring_.size();
    const Point leaving = ring_[(root + 1) % n];
    for (std::size_t i = 0; i < n; ++i) {
      if (ring_[i] != at) continue;
      if (!comes_first(leaving, ring_[(i + n - 1) % n])) return false;
      if (i != root && !comes_first(leaving, ring_[(i + 1) % n])) return false;
    }
    return true;
  }

  Random& random_;
  std::int64_t size_;
  Polygon ring_;
  std::vector<Corners> triangles_;
  std::vector<Segment> bare_;
};

}  // namespace

std::int64_t doubled_area(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

std::int64_t doubled_area(const Polygon& ring) {
  std::int64_t sum = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += doubled_area(ring[0], ring[i], ring[i + 1]);
  return sum;
}

Polygon random_simple(Random& random, int corners, std::int64_t size) {
  Polygon ring;
  do {
    ring = {random_point(random, size), random_point(random, size), random_point(random, size)};
  } while (doubled_area(ring) <= 0);
  for (int tries = 20 * corners; tries > 0 && static_cast<int>(ring.size()) < corners; --tries) {
    const Point p = random_point(random, size);
    const std::size_t n = ring.size();
    const std::size_t e = static_cast<std::size_t>(below(random, static_cast<std::int64_t>(n)));
    const Point a = ring[e];
    const Point b = ring[(e + 1) % n];
    bool free = !on_segment(a, b, p) && !on_segment(a, p, b) && !on_segment(b, p, a);
    for (std::size_t i = 0; i < n && free; ++i) {
      if (i == e) continue;
      const Point& c = ring[i];
      const Point& d = ring[(i + 1) % n];
      // Edges that share a corner with a new edge may touch it there and nowhere else.
      const bool meets_first = d == a ? on_segment(c, d, p) || on_segment(a, p, c) : meet(a, p, c, d);
      const bool meets_second = c == b ? on_segment(c, d, p) || on_segment(p, b, d) : meet(p, b, c, d);
      free = !meets_first && !meets_second;
    }
    if (free) ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(e) + 1, p);
  }
  return ring;
}

Polygon random_weakly_simple(Random& random, int corners, std::int64_t size, bool antennas) {
  DiscGrower grower(random, size);
  for (int tries = 60 * corners; tries > 0 && static_cast<int>(grower.ring().size()) < corners; --tries) {
    if (antennas && below(random, 3) == 0) {
      grower.try_antenna();
    } else {
      grower.try_triangle();
    }
  }
  return grower.ring();
}

Polygon scaled(const Polygon& polygon, std::int64_t factor) {
  Polygon result = polygon;
  for (Point& p : result) p = {p.x * factor, p.y * factor};
  return result;
}

Polygon clip(const Polygon& polygon, int axis, std::int64_t limit, bool keep_above) {
  const auto height = [&](const Point& p) {
    const std::int64_t v = (axis == 0 ? p.x : p.y) - limit;
    return keep_above ? v : -v;
  };
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    if (height(a) >= 0) kept.push_back(a);
    if ((height(a) > 0 && height(b) < 0) || (height(a) < 0 && height(b) > 0)) {
      const std::int64_t along = axis == 0 ? (b.y - a.y) * height(a) : (b.x - a.x) * height(a);
      const std::int64_t whole = height(a) - height(b);
      if (along % whole != 0) std::abort();
      kept.push_back(axis == 0 ? Point{limit, a.y + along / whole} : Point{a.x + along / whole, limit});
    }
  }
  return kept;
}

Polygon with_needles(Random& random, const Polygon& polygon, int count) {
  Polygon ring = polygon;
  for (; count > 0; --count) {
    const std::size_t i = static_cast<std::size_t>(below(random, static_cast<std::int64_t>(ring.size())));
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    // A lattice point of the edge: an end of it, or its middle where that is one.
    const bool has_middle = (a.x + b.x) % 2 == 0 && (a.y + b.y) % 2 == 0;
    const Point middle = has_middle ? Point{(a.x + b.x) / 2, (a.y + b.y) / 2} : a;
    const auto after = ring.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    switch (below(random, 4)) {
      case 0:
        ring.insert(after, a);
        break;
      case 1:
        ring.insert(after, middle);
        break;
      case 2:
        ring.insert(after, {b, a});
        break;
      default:
        ring.insert(after, {b, middle});
        break;
    }
  }
  return ring;
}

std::string fault(const Polygon& ring, const std::vector<Triangle>& triangles) {
  if (triangles.size() + 2 != ring.size()) return fmt::format("{} triangles", triangles.size());
  const std::int64_t sign = doubled_area(ring) < 0 ? -1 : 1;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::vector<Corners> solid;
  std::int64_t sum = 0;
  for (const Triangle& t : triangles) {
    if (std::ranges::any_of(t, [&](std::uint32_t v) { return v >= ring.size(); })) return "no such corner";
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    const std::int64_t area = sign * doubled_area(ring[t[0]], ring[t[1]], ring[t[2]]);
    if (area < 0) return fmt::format("triangle {} is turned over", t);
    sum += area;
    const Corners corners{ring[t[0]], ring[t[1]], ring[t[2]]};
    if (area > 0) solid.push_back(sign > 0 ? corners : Corners{corners[0], corners[2], corners[1]});
  }
  if (sum != sign * doubled_area(ring)) return "areas do not add up";
  for (const auto& [edge, uses] : edges) {
    const auto [from, to] = edge;
    const bool is_ring_edge = to == (from + 1) % ring.size();
    if (uses != 1 || edges.contains({to, from}) == is_ring_edge) return fmt::format("edge {}-{}", from, to);
  }
  for (std::size_t i = 0; i < solid.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!inside_is_free_of(solid[i], {solid[j].begin(), solid[j].end()})) return "triangles overlap";
    }
  }
  return "";
}

std::vector<V3d> to_space(const Polygon& polygon) {
  std::vector<V3d> corners;
  for (const Point& p : polygon)
    corners.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y), 0.0);
  return corners;
}

std::string to_string(const Polygon& polygon) {
  std::string text;
  for (const Point& p : polygon) text += fmt::format("{} {}  ", p.x, p.y);
  return text;
}

}  // namespace farop::lattice
