// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/shapes.h"

#include <algorithm>
#include <array>
#include <utility>

namespace farop::conformance {

TestPolygon polygon_of(const Points& points) {
  TestPolygon polygon;
  for (const Point& p : points) polygon.push_back(corner(p.x, p.y, 0, {}));
  return polygon;
}

TestPolygon rectangle(int x0, int y0, int x1, int y1) {
  return polygon_of({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

TestPolygon moved(TestPolygon polygon, int dx, int dy) {
  for (ScreenVertex& v : polygon) v.x += dx, v.y += dy;
  return polygon;
}

TestPolygon starting_at(TestPolygon polygon, std::size_t first) {
  std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(first % polygon.size()),
              polygon.end());
  return polygon;
}

TestPolygon reversed(TestPolygon polygon) {
  std::ranges::reverse(polygon);
  return polygon;
}

TestPolygon turned_left(TestPolygon polygon) {
  return twice_area(polygon) < 0 ? reversed(std::move(polygon)) : polygon;
}

std::int64_t turn(const Point& a, const Point& b, const Point& c) {
  return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
         (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
}

namespace {

int sign(std::int64_t v) {
  return v > 0 ? 1 : v < 0 ? -1 : 0;
}

/// p lies on the closed segment a b, given that the three are on one line.
bool within(const Point& a, const Point& b, const Point& p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

std::int64_t twice_area_of(const Points& ring) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += std::int64_t{a.x} * b.y - std::int64_t{b.x} * a.y;
  }
  return sum;
}

}  // namespace

bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  const int c_side = sign(turn(a, b, c)), d_side = sign(turn(a, b, d));
  const int a_side = sign(turn(c, d, a)), b_side = sign(turn(c, d, b));
  if (c_side != d_side && a_side != b_side && c_side * d_side <= 0 && a_side * b_side <= 0 &&
      !(c_side == 0 && d_side == 0))
    return true;
  return (c_side == 0 && within(a, b, c)) || (d_side == 0 && within(a, b, d)) ||
         (a_side == 0 && within(c, d, a)) || (b_side == 0 && within(c, d, b));
}

bool is_simple(const Points& ring) {
  const std::size_t n = ring.size();
  if (n < 3) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % n], &c = ring[(i + 2) % n];
    if (a == b) return false;
    // Straight back along the edge that led here.
    if (turn(a, b, c) == 0 && (within(a, b, c) || within(b, c, a))) return false;
    for (std::size_t k = i + 2; k < n; ++k) {
      if (i == 0 && k == n - 1) continue;  // neighbours
      if (segments_meet(a, b, ring[k], ring[(k + 1) % n])) return false;
    }
  }
  return true;
}

Points double_comb(int teeth) {
  Points ring;
  for (int t = 0; t < teeth; ++t) {
    for (const Point& p : {Point{0, 2}, Point{0, 0}, Point{1, 0}, Point{1, 2}})
      ring.push_back({2 * t + p.x, p.y});
  }
  for (int t = teeth - 1; t >= 0; --t) {
    for (const Point& p : {Point{1, 3}, Point{1, 5}, Point{0, 5}, Point{0, 3}})
      ring.push_back({2 * t + p.x, p.y});
  }
  return ring;
}

Points random_simple_polygon(Random& random, int corners, int width, int height) {
  while (true) {
    Points ring;
    for (int tries = 0; static_cast<int>(ring.size()) < corners && tries < 20 * corners; ++tries) {
      const Point p{random.between(0, width - 1), random.between(0, height - 1)};
      if (std::ranges::find(ring, p) == ring.end()) ring.push_back(p);
    }
    // Reversing the part between two crossing edges shortens the ring, so this comes to an end; edges that
    // merely touch are not helped by it, hence the bound.
    const std::size_t n = ring.size();
    for (int rounds = 0; rounds < 200; ++rounds) {
      bool changed = false;
      for (std::size_t i = 0; i + 2 < n; ++i) {
        for (std::size_t k = i + 2; k < n; ++k) {
          if (i == 0 && k == n - 1) continue;
          if (!segments_meet(ring[i], ring[i + 1], ring[k], ring[(k + 1) % n])) continue;
          std::reverse(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                       ring.begin() + static_cast<std::ptrdiff_t>(k) + 1);
          changed = true;
        }
      }
      if (!changed) break;
    }
    if (!is_simple(ring)) continue;
    if (twice_area_of(ring) < 0) std::ranges::reverse(ring);
    return ring;
  }
}

std::vector<std::array<int, 3>> triangulated(const Points& ring) {
  std::vector<int> left;
  for (int i = 0; i < static_cast<int>(ring.size()); ++i) left.push_back(i);
  std::vector<std::array<int, 3>> triangles;
  const auto at = [&](std::size_t i) -> const Point& { return ring[static_cast<std::size_t>(left[i])]; };
  while (left.size() > 3) {
    bool cut = false;
    for (std::size_t i = 0; i < left.size() && !cut; ++i) {
      const std::size_t before = (i + left.size() - 1) % left.size(), after = (i + 1) % left.size();
      const Point &a = at(before), &b = at(i), &c = at(after);
      if (turn(a, b, c) <= 0) continue;
      bool empty = true;
      for (std::size_t k = 0; k < left.size() && empty; ++k) {
        if (k == before || k == i || k == after) continue;
        const Point& p = at(k);
        empty = turn(a, b, p) < 0 || turn(b, c, p) < 0 || turn(c, a, p) < 0;
      }
      if (!empty) continue;
      triangles.push_back({left[before], left[i], left[after]});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
      cut = true;
    }
    if (cut) continue;
    // Only straight corners are left to remove: they have no ear of their own.
    for (std::size_t i = 0; i < left.size(); ++i) {
      const std::size_t before = (i + left.size() - 1) % left.size(), after = (i + 1) % left.size();
      if (turn(at(before), at(i), at(after)) == 0) {
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
        cut = true;
        break;
      }
    }
    if (!cut) return triangles;  // not simple: the caller checks the area
  }
  if (left.size() == 3 && turn(at(0), at(1), at(2)) != 0) triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

std::vector<TestPolygon> random_mesh(Random& random, int points, int width, int height) {
  const int right = width - 1, top = height - 1;
  Points at = {{0, 0}, {right, 0}, {right, top}, {0, top}};
  std::vector<std::array<std::size_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  for (int n = 0; n < points; ++n) {
    Point p{random.between(0, right), random.between(0, top)};
    // Every eighth one on the border.
    if (n % 8 == 7) (n % 16 == 7 ? p.x : p.y) = random.below(2) == 0 ? 0 : (n % 16 == 7 ? right : top);
    if (std::ranges::find(at, p) != at.end()) continue;
    const std::size_t index = at.size();
    at.push_back(p);
    std::vector<std::array<std::size_t, 3>> next;
    for (const auto& [a, b, c] : triangles) {
      const std::int64_t ab = turn(at[a], at[b], p), bc = turn(at[b], at[c], p), ca = turn(at[c], at[a], p);
      if (ab < 0 || bc < 0 || ca < 0) {
        next.push_back({a, b, c});
        continue;
      }
      // A point on an edge splits that triangle in two, and its neighbour likewise.
      if (ab > 0) next.push_back({a, b, index});
      if (bc > 0) next.push_back({b, c, index});
      if (ca > 0) next.push_back({c, a, index});
    }
    triangles = std::move(next);
  }
  std::vector<TestPolygon> mesh;
  for (const auto& [a, b, c] : triangles) mesh.push_back(polygon_of({at[a], at[b], at[c]}));
  return mesh;
}

}  // namespace farop::conformance
