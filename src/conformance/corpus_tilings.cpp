// SPDX-License-Identifier: GPL-3.0-or-later
// Family `tile`: polygons that share edges. What they cover together follows from exact coverage, so cracks
// that rounding has made are expected where they are.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "conformance/corpus_builder.h"

namespace farop::conformance {
namespace {

void put(CorpusBuilder& b, const std::string& name, std::string purpose, std::vector<TestPolygon> polygons,
         const Resolution& frame = k_f64) {
  b.add(name, CaseKind::tiling, std::move(purpose), identified(frame, std::move(polygons)));
}

void add_fans(CorpusBuilder& b) {
  const std::array<Points, 3> rings = {
      {{{60, 32}, {52, 52}, {32, 60}, {12, 52}, {4, 32}, {12, 12}, {32, 4}, {52, 12}},
       {{62, 30},
        {55, 44},
        {50, 58},
        {40, 50},
        {30, 60},
        {18, 55},
        {4, 48},
        {10, 33},
        {2, 20},
        {20, 16},
        {34, 3},
        {48, 12}},
       {{63, 32},
        {60, 40},
        {57, 52},
        {44, 55},
        {32, 63},
        {25, 57},
        {12, 56},
        {8, 42},
        {0, 32},
        {6, 20},
        {10, 10},
        {23, 8},
        {32, 0},
        {42, 9},
        {54, 11},
        {57, 24}}}};
  for (const Points& ring : rings) {
    for (const Point& centre : {Point{32, 32}, Point{30, 34}, Point{35, 31}}) {
      std::vector<TestPolygon> fan;
      for (std::size_t i = 0; i < ring.size(); ++i)
        fan.push_back(polygon_of({centre, ring[i], ring[(i + 1) % ring.size()]}));
      put(b, "fan", "A fan around a lattice point: its centre belongs to exactly one triangle.", fan);
    }
    std::vector<TestPolygon> half;
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      if (ring[i].y >= 32 && ring[i + 1].y >= 32)
        half.push_back(polygon_of({{32, 0}, {ring[i].x, ring[i].y}, {ring[i + 1].x, ring[i + 1].y}}));
    }
    put(b, "fan", "A fan around a point on the frame's border.", half);
  }
}

void add_grids(CorpusBuilder& b) {
  for (int shear = 0; shear <= 7; ++shear) {
    for (int kind = 0; kind < 3; ++kind) {  // quads, two diagonals
      std::vector<TestPolygon> cells;
      const int n = 4 + shear % 3, size = 6;
      const auto at = [&](int i, int k) {
        return Point{4 + i * size + k * shear / 2 + k % 2, 4 + k * 7 + i % 2};
      };
      for (int k = 0; k < 6; ++k) {
        for (int i = 0; i < n; ++i) {
          const Point p = at(i, k), q = at(i + 1, k), r = at(i + 1, k + 1), s = at(i, k + 1);
          if (kind == 0) {
            cells.push_back(polygon_of({p, q, r, s}));
          } else if (kind == 1) {
            cells.push_back(polygon_of({p, q, r})), cells.push_back(polygon_of({p, r, s}));
          } else {
            cells.push_back(polygon_of({p, q, s})), cells.push_back(polygon_of({q, r, s}));
          }
        }
      }
      put(b, "grid",
          fmt::format("A grid sheared by {}, as {}.", shear, kind == 0 ? "quadrilaterals" : "triangles"),
          cells);
    }
  }
}

void add_meshes(CorpusBuilder& b) {
  for (std::uint64_t i = 0; i < b.times(10); ++i) {
    Random random = b.random("random-mesh");
    constexpr std::array sizes = {16, 24, 40, 60, 100, 160, 250, 400};
    put(b, "random-mesh", "A random triangulation of the whole frame.",
        random_mesh(random, sizes[i % sizes.size()], 64, 64));
    b.seeded();
  }
}

void add_concave_pairs(CorpusBuilder& b) {
  for (std::uint64_t i = 0; i < b.times(12); ++i) {
    Random random = b.random("concave-pair");
    Points ring = random_simple_polygon(random, random.between(5, 16), 56, 56);
    for (Point& p : ring) p = {p.x + 4, p.y + 4};
    // The rest of the frame: around the border, in over a bridge to the lowest corner, round it, and back.
    const auto lowest =
        std::ranges::min_element(ring, {}, [](const Point& p) { return std::pair(p.y, p.x); });
    std::rotate(ring.begin(), lowest, ring.end());
    Points rest = {{ring.front().x, 0}, {63, 0}, {63, 63}, {0, 63}, {0, 0}, {ring.front().x, 0}};
    rest.push_back(ring.front());
    for (std::size_t k = ring.size() - 1; k > 0; --k) rest.push_back(ring[k]);
    rest.push_back(ring.front());
    put(b, "concave-pair", "A random simple polygon and the rest of the frame.",
        {polygon_of(ring), polygon_of(rest)});
    b.seeded();
    std::vector<TestPolygon> triangles;
    for (const auto& t : triangulated(ring)) {
      triangles.push_back(
          polygon_of({ring[static_cast<std::size_t>(t[0])], ring[static_cast<std::size_t>(t[1])],
                      ring[static_cast<std::size_t>(t[2])]}));
    }
    triangles.push_back(polygon_of(rest));
    put(b, "concave-pair", "The same polygon in triangles, and the rest of the frame.", triangles);
    b.seeded();
  }
}

void add_t_junctions(CorpusBuilder& b) {
  // Long edge (0,0)-(7k,3k); the other side has a vertex on it, or beside it where rounding would put one.
  for (const int k : {1, 2, 8}) {
    const Point a{4, 20}, z{4 + 7 * k, 20 + 3 * k};
    const Point below{4 + 7 * k, 4}, above{4, 50};
    const TestPolygon whole = polygon_of({a, below, z});
    for (int part = 1; part < k; ++part) {
      const Point t{4 + 7 * part, 20 + 3 * part};
      put(b, "t-on", "A vertex exactly on a neighbour's long edge: no crack.",
          {whole, polygon_of({a, t, above}), polygon_of({t, z, above})});
    }
    for (const Point& off : {Point{2, 1}, Point{4, 2}, Point{5, 2}, Point{3, 1}, Point{4, 1}}) {
      const Point t{4 + off.x * k, 20 + off.y * k};
      put(b, "t-off", "A vertex rounded off a long edge: the crack, or overlap, is right as it is.",
          {whole, polygon_of({a, t, above}), polygon_of({t, z, above})});
    }
  }
}

struct Solid {
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<int>> faces;  ///< counter-clockwise from outside
};

Solid torus(int around, int across) {
  Solid s;
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < across; ++k) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * k / across;
      s.points.push_back({(2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v)});
      const int i1 = (i + 1) % around, k1 = (k + 1) % across;
      const int a = i * across + k, b = i1 * across + k, c = i1 * across + k1, d = i * across + k1;
      s.faces.push_back({a, b, c}), s.faces.push_back({a, c, d});
    }
  }
  return s;
}

void add_solids(CorpusBuilder& b) {
  const Solid cube{
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  const Solid octahedron{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  const auto draw = [&b](const Solid& solid, double scale, double tilt, double spin, const char* what) {
    Points at;
    for (const auto& [x, y, z] : solid.points) {
      const double u = x * std::cos(spin) - y * std::sin(spin), v = x * std::sin(spin) + y * std::cos(spin);
      const double w = v * std::cos(tilt) - z * std::sin(tilt);
      const auto place = [&](double c) {
        return static_cast<int>(std::floor((std::round(c * scale * 1000) + 500) / 1000)) + 128;
      };
      at.push_back({place(u), place(w)});
    }
    std::vector<TestPolygon> front;
    for (const std::vector<int>& face : solid.faces) {
      Points ring;
      for (const int i : face) ring.push_back(at[static_cast<std::size_t>(i)]);
      const TestPolygon polygon = polygon_of(ring);
      if (twice_area(polygon) > 0) front.push_back(polygon);
    }
    put(b, "solid", fmt::format("The front faces of {}, rounded to the lattice, fill its outline.", what),
        front, k_f256);
  };
  draw(cube, 60, 0.6, 0.4, "a cube");
  draw(octahedron, 100, 0.5, 0.3, "an octahedron");
  draw(torus(26, 24), 40, 0.3, 0.1, "a torus");
}

void add_slivers(CorpusBuilder& b) {
  for (const int height : {1, 2, 3}) {
    std::vector<TestPolygon> strip;
    for (int i = 0; i < 50; ++i) {
      const Point a{4 + 2 * i, 20 + i / 7}, c{4 + 2 * (i + 1), 20 + (i + 1) / 7};
      const Point up{a.x, a.y + height}, next{c.x, c.y + height};
      strip.push_back(polygon_of({a, c, up}));
      strip.push_back(polygon_of({c, next, up}));
    }
    put(b, "sliver-strip", "A strip of 100 thin triangles.", strip, k_f256);
  }
  std::vector<TestPolygon> strip;
  for (int i = 0; i < 50; ++i) {
    const Point a{4 + 4 * i, 30 + i}, c{4 + 4 * (i + 1), 30 + i + 1};
    strip.push_back(polygon_of({a, c, {a.x, a.y + 1}}));
    strip.push_back(polygon_of({c, {c.x, c.y + 1}, {a.x, a.y + 1}}));
  }
  put(b, "sliver-strip", "A strip of 100 triangles of area 2 along a slope of 1/4.", strip, k_f256);
}

}  // namespace

void add_tilings(std::vector<Case>& corpus, const CorpusOptions& options) {
  CorpusBuilder b(corpus, options, "tile");
  put(b, "hexagon", "A hexagon in three rhombi: 768 samples, each once.",
      {moved(polygon_of({{16, 16}, {16, 32}, {0, 24}, {0, 8}}), 8, 8),
       moved(polygon_of({{16, 16}, {0, 8}, {16, 0}, {32, 8}}), 8, 8),
       moved(polygon_of({{16, 16}, {32, 8}, {32, 24}, {16, 32}}), 8, 8)});
  add_fans(b);
  add_grids(b);
  add_meshes(b);
  add_concave_pairs(b);
  add_t_junctions(b);
  add_solids(b);
  add_slivers(b);
}

}  // namespace farop::conformance
