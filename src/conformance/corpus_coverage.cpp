// SPDX-License-Identifier: GPL-3.0-or-later
// Family `cov`: one polygon at a time.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "conformance/corpus_builder.h"

namespace farop::conformance {
namespace {

void add_tile(CorpusBuilder& b, const std::string& name, std::string purpose, TestPolygon polygon) {
  b.add(name, CaseKind::coverage, std::move(purpose), identified(k_f64, {std::move(polygon)})).tile = true;
}

void add_units(CorpusBuilder& b) {
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x)
      add_tile(b, "unit", "A square of one pixel, at every place of a tile.", rectangle(x, y, x + 1, y + 1));
  }
  const std::array<Point, 8> places = {
      {{0, 0}, {31, 0}, {62, 0}, {0, 31}, {62, 31}, {0, 62}, {31, 62}, {62, 62}}};
  std::vector<TestPolygon> squares;
  for (const Point& p : places) squares.push_back(rectangle(p.x, p.y, p.x + 1, p.y + 1));
  b.add("unit", CaseKind::coverage,
        "Squares of one pixel in the corners and at the middles of the frame's sides.",
        identified(k_f64, squares));
}

Point lattice_point(int i) {
  return {i % 4, i / 4};
}

void add_triangles(CorpusBuilder& b) {
  for (int i = 0; i < 16; ++i) {
    for (int j = i + 1; j < 16; ++j) {
      for (int k = j + 1; k < 16; ++k) {
        const TestPolygon left =
            turned_left(polygon_of({lattice_point(i), lattice_point(j), lattice_point(k)}));
        if (twice_area(left) == 0) continue;
        for (std::size_t first = 0; first < 3; ++first)
          add_tile(b, "tri4", "Every triangle of a 4 x 4 lattice, counter-clockwise, from every corner.",
                   starting_at(left, first));
        for (std::size_t first = 0; first < 3; ++first)
          add_tile(b, "tri4", "Every triangle of a 4 x 4 lattice, clockwise, from every corner.",
                   starting_at(reversed(left), first));
      }
    }
  }
}

void add_quads(CorpusBuilder& b) {
  constexpr std::array<std::array<int, 4>, 3> orders = {{{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 1, 3, 2}}};
  for (int mask = 0; mask < 1 << 16; ++mask) {
    if (__builtin_popcount(static_cast<unsigned>(mask)) != 4) continue;
    Points four;
    for (int i = 0; i < 16; ++i) {
      if ((mask >> i & 1) != 0) four.push_back(lattice_point(i));
    }
    for (const auto& order : orders) {
      Points ring;
      for (const int i : order) ring.push_back(four[static_cast<std::size_t>(i)]);
      bool straight = false;
      for (std::size_t i = 0; i < 4; ++i)
        straight = straight || turn(ring[i], ring[(i + 1) % 4], ring[(i + 2) % 4]) == 0;
      if (straight || !is_simple(ring)) continue;
      const TestPolygon left = turned_left(polygon_of(ring));
      add_tile(b, "quad4", "Every quadrilateral of a 4 x 4 lattice, counter-clockwise.", left);
      add_tile(b, "quad4", "Every quadrilateral of a 4 x 4 lattice, clockwise.", reversed(left));
    }
  }
}

void add_random_triangles(CorpusBuilder& b) {
  for (std::uint64_t i = 0; i < b.times(256); ++i) {
    Random random = b.random("tri-random");
    b.add("tri-random", CaseKind::coverage, "A random triangle.",
          identified(k_f64, {random_triangle(random, 64, 64)}));
    b.seeded();
  }
  for (std::uint64_t i = 0; i < b.times(64); ++i) {
    Random random = b.random("tri-random");
    TestPolygon t;
    do {
      const int k = random.between(2, 7), room = 63 / k;
      const Point o{random.between(0, 63 - k * room), random.between(0, 63 - k * room)};
      Points p = random_points(random, 3, room + 1, room + 1);
      for (Point& q : p) q = {o.x + k * q.x, o.y + k * q.y};
      t = turned_left(polygon_of(p));
    } while (twice_area(t) == 0);
    b.add("tri-random", CaseKind::coverage,
          "A random triangle whose edges pass through inner lattice points.", identified(k_f64, {t}));
    b.seeded();
  }
}

void add_fan_slopes(CorpusBuilder& b) {
  Points border;
  for (int x = 0; x < 63; ++x) border.push_back({x, 0});
  for (int y = 0; y < 63; ++y) border.push_back({63, y});
  for (int x = 63; x > 0; --x) border.push_back({x, 63});
  for (int y = 63; y > 0; --y) border.push_back({0, y});
  for (std::size_t i = 0; i < border.size(); ++i) {
    const TestPolygon t = polygon_of({{32, 32}, border[i], border[(i + 1) % border.size()]});
    if (twice_area(t) == 0) continue;
    b.add("fan-slopes", CaseKind::coverage, "A thin triangle from the middle to the border: every slope.",
          identified(k_f64, {t}));
  }
}

void add_unimodular(CorpusBuilder& b) {
  std::array<int, 13> f{1, 1};
  for (std::size_t i = 2; i < f.size(); ++i) f[i] = f[i - 1] + f[i - 2];
  for (std::size_t n = 2; n <= 10; ++n) {
    const Point p{f[n], f[n - 1]}, q{f[n + 1], f[n]};
    const std::string purpose =
        "A triangle of area 1/2 with Fibonacci's slopes; with its reflection it covers one pixel.";
    b.add("unimodular", CaseKind::coverage, purpose, identified(k_f256, {polygon_of({{0, 0}, p, q})}));
    // Reflected through the middle of p q.
    b.add("unimodular", CaseKind::coverage, purpose,
          identified(k_f256, {polygon_of({{p.x + q.x, p.y + q.y}, p, q})}));
  }
}

void add_needles(CorpusBuilder& b) {
  for (int variant = 0; variant < 8; ++variant) {
    std::vector<TestPolygon> needles;
    for (int length = 1; length <= 62; ++length) {
      Points p = {{0, 0}, {length, 1}, {length, 0}};
      for (Point& q : p) {
        if ((variant & 1) != 0) q.x = length - q.x;
        if ((variant & 2) != 0) q.y = 1 - q.y;
        q.x += 4, q.y += 4 * length;
        if ((variant & 4) != 0) std::swap(q.x, q.y);
      }
      needles.push_back(polygon_of(p));
    }
    b.add("needle", CaseKind::coverage, "Needles one pixel high or wide and up to 62 long.",
          identified(k_f256, needles));
  }
}

void add_horizontals(CorpusBuilder& b) {
  for (int steps = 1; steps <= 8; ++steps) {
    for (int kind = 0; kind < 3; ++kind) {  // up, down, both
      Points ring = {{4, 4}, {60, 4}};
      const int width = 56 / (kind == 2 ? 2 * steps : steps);
      int x = 60;
      if (kind == 2) {
        for (int s = 0; s < steps; ++s)
          ring.push_back({x, 8 + 4 * s}), ring.push_back({x -= width, 8 + 4 * s});
        for (int s = steps - 1; s > 0; --s)
          ring.push_back({x, 4 + 4 * s}), ring.push_back({x -= width, 4 + 4 * s});
        ring.push_back({x, 4});
        if (x == 4) ring.erase(ring.begin());
      } else {
        for (int s = 0; s < steps; ++s) {
          const int y = kind == 0 ? 8 + 4 * s : 8 + 4 * (steps - 1 - s);
          ring.push_back({x, y});
          x = s == steps - 1 ? 4 : x - width;
          ring.push_back({x, y});
        }
      }
      b.add("horizontal", CaseKind::coverage, "A staircase: horizontal edges at many heights.",
            identified(k_f64, {turned_left(polygon_of(ring))}));
    }
  }
  const std::vector<Points> plateaus = {
      {{10, 10}, {50, 30}, {40, 50}, {20, 50}},                               // at the top
      {{20, 10}, {40, 10}, {50, 30}, {10, 50}},                               // at the bottom
      {{10, 10}, {50, 10}, {50, 30}, {30, 30}, {30, 50}, {10, 50}},           // inside, to the left
      {{10, 10}, {50, 10}, {50, 50}, {30, 50}, {30, 30}, {10, 30}},           // inside, to the right
      {{10, 10}, {30, 20}, {50, 10}, {60, 40}, {40, 30}, {20, 30}, {5, 40}},  // between reflex corners
      {{10, 10}, {20, 10}, {30, 10}, {50, 10}, {50, 40}, {40, 40}, {25, 40}, {10, 40}},  // in pieces
      {{10, 10}, {50, 10}, {60, 30}, {40, 30}, {35, 50}, {25, 50}, {20, 30}, {0, 30}}};
  for (const Points& ring : plateaus) {
    b.add("horizontal", CaseKind::coverage, "A plateau at the top, at the bottom or between.",
          identified(k_f64, {turned_left(polygon_of(ring))}));
    b.add("horizontal", CaseKind::coverage, "A plateau at the top, at the bottom or between, clockwise.",
          identified(k_f64, {reversed(turned_left(polygon_of(ring)))}));
  }
}

/// A corner at (32,32) between an edge that comes from one direction and an edge that goes to another, closed
/// around the side that is asked for.
void add_vertex_kinds(CorpusBuilder& b) {
  const std::array<Point, 4> directions = {{{9, 14}, {-11, -13}, {14, 0}, {-14, 0}}};
  for (std::size_t from = 0; from < directions.size(); ++from) {
    for (std::size_t to = 0; to < directions.size(); ++to) {
      if (from >= 2 && to >= 2) continue;
      for (const bool mirrored : {false, true}) {
        // The corner's neighbours: for equal directions a second slope of the same kind.
        Point in = directions[from], out = directions[to];
        if (from == to) out = {out.x + 12, out.y};
        if (mirrored) in.x = -in.x, out.x = -out.x;
        const Point c{32, 32}, p{c.x + in.x, c.y + in.y}, q{c.x + out.x, c.y + out.y};
        if (turn(p, c, q) == 0) continue;
        // Convex: the triangle. Reflex: a box around it with that triangle as a notch.
        b.add("vertex-kinds", CaseKind::coverage,
              "A convex corner between rising, falling or horizontal edges.",
              identified(k_f64, {turned_left(polygon_of({p, c, q}))}));
        const Points ring = {p, c, q};
        const TestPolygon notch = turned_left(polygon_of(ring));
        // Keyhole: out to the box and back along one bridge gives the complement of the triangle.
        TestPolygon around = polygon_of({{2, 2}, {61, 2}, {61, 61}, {2, 61}, {2, 2}});
        TestPolygon inner = reversed(notch);
        const auto hits = [&inner] {
          const auto at = [&](std::size_t i) { return Point{inner[i % 3].x, inner[i % 3].y}; };
          return segments_meet({2, 2}, at(0), at(1), at(2));
        };
        while (hits()) inner = starting_at(inner, 1);
        for (const ScreenVertex& v : inner) around.push_back(v);
        around.push_back(inner.front());
        b.add("vertex-kinds", CaseKind::coverage,
              "A reflex corner between rising, falling or horizontal edges, with crossings on both sides.",
              identified(k_f64, {around}));
      }
    }
  }
}

void add_convex(CorpusBuilder& b) {
  for (int n = 3; n <= 24; ++n) {
    for (int turned = 0; turned < 12; ++turned) {
      Points ring;
      for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * (i + turned / 12.0) / n;
        // Rounded in thousandths first: the last bits of cos differ between libraries.
        const auto place = [](double v) {
          return static_cast<int>(std::floor((std::round(v * 1000) + 500) / 1000)) + 32;
        };
        const Point p{place(20 * std::cos(angle)), place(20 * std::sin(angle))};
        if (ring.empty() || ring.back() != p) ring.push_back(p);
      }
      b.add("convex", CaseKind::coverage, "A regular polygon, rounded to the lattice.",
            identified(k_f64, {polygon_of(ring)}));
    }
  }
}

Points comb(int teeth, int tooth, int gap, bool uneven) {
  Points ring = {{0, 0}};
  const int width = teeth * tooth + (teeth - 1) * gap;
  ring.push_back({width, 0});
  for (int t = teeth - 1; t >= 0; --t) {
    const int left = t * (tooth + gap), height = uneven ? 8 + 5 * t % 17 : 20;
    ring.push_back({left + tooth, height});
    ring.push_back({left, height});
    if (t > 0) {
      ring.push_back({left, 4});
      ring.push_back({left - gap, 4});
    }
  }
  return ring;
}

void add_combs(CorpusBuilder& b) {
  for (int teeth = 1; teeth <= 15; ++teeth) {
    for (const int tooth : {1, 2}) {
      for (const int gap : {1, 2}) {
        // Teeth up, left, down, right in turn, so that all directions come with all widths.
        Points ring = comb(teeth, tooth, gap, false);
        const int way = (teeth + tooth + 2 * gap) % 4;
        for (Point& p : ring) {
          for (int q = 0; q < way; ++q) p = {60 - p.y, p.x};
          p = {p.x + (way == 3 || way == 0 ? 2 : 0), p.y + 2};
          p = {std::clamp(p.x, 0, 63), std::clamp(p.y, 0, 63)};
        }
        b.add("comb", CaseKind::coverage, "A comb: many crossings in a row.",
              identified(k_f64, {turned_left(polygon_of(ring))}));
      }
    }
    b.add("comb", CaseKind::coverage, "A comb with teeth of different heights.",
          identified(k_f64, {turned_left(moved(polygon_of(comb(teeth, 2, 2, true)), 1, 3))}));
  }
}

void add_stars_and_spirals(CorpusBuilder& b) {
  for (int points = 3; points <= 12; ++points) {
    Points ring;
    for (int i = 0; i < 2 * points; ++i) {
      const double radius = i % 2 == 0 ? 30 : 11, angle = std::numbers::pi * (i + 0.1) / points;
      const auto place = [](double v) {
        return static_cast<int>(std::floor((std::round(v * 1000) + 500) / 1000)) + 32;
      };
      ring.push_back({place(radius * std::cos(angle)), place(radius * std::sin(angle))});
    }
    if (is_simple(ring)) {
      b.add("star", CaseKind::coverage, "A star: convex and reflex corners in turn.",
            identified(k_f64, {polygon_of(ring)}));
    }
  }
  for (int turns = 1; turns <= 5; ++turns) {
    // Outwards along one side of a corridor, back along the other.
    Points out, back;
    for (int t = 0; t <= turns; ++t) {
      const int r = 4 + 5 * t;
      for (const Point& p :
           {Point{32 - r + 5, 32 - r}, Point{32 + r, 32 - r}, Point{32 + r, 32 + r}, Point{32 - r, 32 + r}})
        out.push_back(p);
    }
    back = out;
    for (std::size_t i = 0; i < back.size(); ++i) {
      const std::size_t side = i % 4;
      back[i].x += side == 1 || side == 2 ? -2 : 2;
      back[i].y += side == 0 || side == 1 ? 2 : -2;
    }
    back.front().x -= 2, out.front().x -= 0;
    Points ring = out;
    std::ranges::reverse(back);
    ring.insert(ring.end(), back.begin(), back.end());
    b.add("spiral", CaseKind::coverage, "A rectangular spiral: many crossings in a row and a column.",
          identified(k_f64, {turned_left(polygon_of(ring))}));
  }
}

void add_bridges(CorpusBuilder& b) {
  const Points outer = {{2, 2}, {60, 2}, {60, 60}, {2, 60}};
  struct Hole {
    Points ring;  ///< clockwise, begins at the bridge's end
    Point gate;   ///< on the outer ring, where the bridge begins
    const char* what;
  };
  const std::vector<Hole> holes = {{{{20, 30}, {30, 40}, {40, 30}, {30, 20}}, {2, 30}, "horizontal"},
                                   {{{30, 20}, {20, 30}, {30, 40}, {40, 30}}, {30, 2}, "vertical"},
                                   {{{20, 20}, {20, 40}, {40, 40}, {40, 20}}, {2, 2}, "slanted"}};
  for (const Hole& hole : holes) {
    Points ring = {outer[0]};
    if (hole.gate == outer[0]) {
      ring.insert(ring.end(), hole.ring.begin(), hole.ring.end());
      ring.push_back(hole.ring.front());
      ring.push_back(outer[0]);
      ring.insert(ring.end(), outer.begin() + 1, outer.end());
    } else if (hole.gate.y == 2) {
      ring.push_back(hole.gate);
      ring.insert(ring.end(), hole.ring.begin(), hole.ring.end());
      ring.push_back(hole.ring.front());
      ring.push_back(hole.gate);
      ring.insert(ring.end(), outer.begin() + 1, outer.end());
    } else {
      ring.insert(ring.end(), outer.begin() + 1, outer.end());
      ring.push_back(hole.gate);
      ring.insert(ring.end(), hole.ring.begin(), hole.ring.end());
      ring.push_back(hole.ring.front());
      ring.push_back(hole.gate);
    }
    b.add("bridge", CaseKind::coverage,
          fmt::format("A hole joined to the outside by a {} bridge, walked in both directions.", hole.what),
          identified(k_f64, {polygon_of(ring)}));
    b.add("bridge", CaseKind::coverage, fmt::format("The same with a {} bridge, clockwise.", hole.what),
          identified(k_f64, {reversed(polygon_of(ring))}));
  }
  b.add("bridge", CaseKind::coverage, "Two bridges that begin at one vertex.",
        identified(k_f64, {polygon_of({{2, 2},
                                       {20, 12},
                                       {20, 24},
                                       {30, 12},
                                       {20, 12},
                                       {2, 2},
                                       {12, 20},
                                       {12, 40},
                                       {24, 40},
                                       {12, 20},
                                       {2, 2},
                                       {60, 2},
                                       {60, 60},
                                       {2, 60}})}));
  // What clipping makes of an M: two towers joined along the clip edge.
  b.add(
      "bridge", CaseKind::coverage, "Two towers joined by an edge walked twice, as clipping leaves them.",
      identified(k_f64, {polygon_of({{4, 50}, {10, 10}, {16, 50}, {40, 50}, {48, 10}, {56, 50}, {16, 50}})}));
}

void add_duplicates(CorpusBuilder& b) {
  const Points triangle = {{6, 6}, {50, 16}, {24, 55}};
  const auto put = [&b](const Points& ring, const char* purpose) {
    b.add("dup", CaseKind::coverage, purpose, identified(k_f64, {polygon_of(ring)}));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    for (const std::size_t copies : {1u, 2u}) {
      Points ring = triangle;
      ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(i), copies, triangle[i]);
      put(ring, "A corner that is repeated.");
    }
  }
  Points closed = triangle;
  closed.push_back(triangle.front());
  put(closed, "The last corner repeats the first.");
  for (int run = 1; run <= 5; ++run) {
    Points ring = {{4, 4}};
    for (int i = 1; i <= run; ++i) ring.push_back({4 + 6 * i, 4 + 3 * i});
    ring.insert(ring.end(), {{46, 25}, {30, 58}, {8, 40}});
    put(ring, "Corners in a straight line, slanted.");
    ring = {{4, 4}};
    for (int i = 1; i <= run; ++i) ring.push_back({4 + 8 * i, 4});
    ring.push_back({58, 4});
    for (int i = 1; i <= run; ++i) ring.push_back({58, 4 + 8 * i});
    ring.push_back({58, 58});
    put(ring, "Corners in a straight line, horizontal and vertical.");
  }
  put({{6, 6}, {50, 6}, {60, 6}, {50, 6}, {50, 40}}, "A spike: out and back, horizontally.");
  put({{6, 6}, {50, 6}, {50, 40}, {50, 60}, {50, 40}}, "A spike: out and back, vertically.");
  put({{6, 6}, {50, 6}, {50, 40}, {61, 57}, {50, 40}}, "A spike: out and back, slanted.");
  put({{10, 10}, {50, 10}, {50, 50}, {30, 30}, {50, 50}, {10, 50}}, "A spike that points inwards.");
}

void add_zero_areas(CorpusBuilder& b) {
  const std::vector<Points> rings = {{{4, 10}, {30, 10}, {60, 10}},
                                     {{10, 4}, {10, 30}, {10, 60}},
                                     {{4, 4}, {30, 30}, {60, 60}},
                                     {{4, 60}, {30, 34}, {60, 4}},
                                     {{7, 5}, {27, 15}, {47, 25}, {27, 15}},
                                     {{20, 20}, {20, 20}, {20, 20}},
                                     {{20, 20}, {20, 20}, {20, 20}, {20, 20}},
                                     {{4, 4}, {60, 4}, {60, 30}, {60, 4}},
                                     {{4, 4}, {40, 50}, {60, 10}, {40, 50}},
                                     {{0, 0}, {63, 0}, {0, 0}},
                                     {{63, 0}, {63, 63}, {63, 20}}};
  for (const Points& ring : rings) {
    b.add("zero-area", CaseKind::coverage, "A polygon without area: nothing may appear.",
          identified(k_f64, {polygon_of(ring)}));
  }
}

void add_borders(CorpusBuilder& b) {
  constexpr int e = 63;
  const std::vector<Points> rings = {{{0, 0}, {e, 0}, {e, e}, {0, e}},
                                     {{0, 0}, {e, 0}, {30, 20}},
                                     {{e, 0}, {e, e}, {40, 30}},
                                     {{0, e}, {20, 40}, {e, e}},
                                     {{0, 0}, {20, 30}, {0, e}},
                                     {{0, 0}, {10, 0}, {10, 10}, {0, 10}},
                                     {{53, 0}, {e, 0}, {e, 10}, {53, 10}},
                                     {{0, 53}, {10, 53}, {10, e}, {0, e}},
                                     {{53, 53}, {e, 53}, {e, e}, {53, e}},
                                     {{0, 0}, {e, 0}, {e, e}},
                                     {{0, 0}, {e, e}, {0, e}},
                                     {{0, 0}, {e, 0}, {0, e}},
                                     {{e, 0}, {e, e}, {0, e}},
                                     {{0, 0}, {e, 1}, {e, e}, {1, e}}};
  for (const Points& ring : rings) {
    b.add("border", CaseKind::coverage, "An edge on the frame's border, or a vertex in its corner.",
          identified(k_f64, {turned_left(polygon_of(ring))}));
  }
}

void add_sizes(CorpusBuilder& b) {
  const std::vector<std::pair<int, int>> sizes = {{1, 1},   {1, 64},   {64, 1},   {2, 2},      {3, 5},
                                                  {61, 67}, {4096, 8}, {8, 4096}, {2048, 2048}};
  for (const auto& [width, height] : sizes) {
    const Resolution frame{width, height, 512, 256};
    const int r = width - 1, t = height - 1;
    b.add("size", CaseKind::coverage, fmt::format("A frame of {} x {}, full.", width, height),
          identified(frame, {rectangle(0, 0, r, t)}));
    b.add("size", CaseKind::coverage, fmt::format("A frame of {} x {}, a slanted triangle.", width, height),
          identified(frame, {polygon_of({{0, 0}, {r, t / 3}, {r / 2, t}})}));
  }
}

void add_big_polygons(CorpusBuilder& b) {
  Points circle;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 1000, radius = i % 2 == 0 ? 250 : 230;
    const auto place = [](double v) {
      return static_cast<int>(std::floor((std::round(v * 1000) + 500) / 1000)) + 256;
    };
    circle.push_back({place(radius * std::cos(angle)), place(radius * std::sin(angle))});
  }
  b.add("big-n", CaseKind::coverage, "A polygon of 1000 corners.", identified(k_f512, {polygon_of(circle)}));
  const Resolution wide{5004, 8, 512, 256};
  b.add("big-n", CaseKind::coverage, "A comb of 20,000 corners.",
        identified(wide, {moved(polygon_of(double_comb(2500)), 1, 1)}));
  if (b.level() != Level::thorough) return;
  std::vector<TestPolygon> needles;
  for (int y = 0; y + 1 < 1024; y += 2) {
    for (int x = 0; x + 4 < 1024; x += 5) needles.push_back(polygon_of({{x, y}, {x + 4, y + 1}, {x + 4, y}}));
  }
  // More than there are identification colours: judged pixel by pixel, not polygon by polygon.
  b.add("big-n", CaseKind::picture, "100,000 needles in one frame.", identified(k_f1k, needles));
}

}  // namespace

void add_coverage(std::vector<Case>& corpus, const CorpusOptions& options) {
  CorpusBuilder b(corpus, options, "cov");
  add_units(b);
  add_triangles(b);
  add_quads(b);
  if (options.level == Level::quick) return;
  add_random_triangles(b);
  add_fan_slopes(b);
  add_unimodular(b);
  add_needles(b);
  add_horizontals(b);
  add_vertex_kinds(b);
  add_convex(b);
  add_combs(b);
  add_stars_and_spirals(b);
  add_bridges(b);
  add_duplicates(b);
  add_zero_areas(b);
  add_borders(b);
  add_sizes(b);
  add_big_polygons(b);
}

}  // namespace farop::conformance
