// SPDX-License-Identifier: GPL-3.0-or-later
// Family `colour`.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "conformance/corpus_builder.h"

namespace farop::conformance {
namespace {

/// 64 polygons in cells of 32 x 32 pixels.
template <class Make>
Drawing in_cells(const Make& make) {
  Drawing drawing{k_f256, {}};
  for (int cell = 0; cell < 64; ++cell) {
    drawing.polygons.push_back(moved(make(cell), 32 * (cell % 8) + 1, 32 * (cell / 8) + 1));
    set_depth(drawing.polygons.back(), 100);
  }
  return drawing;
}

Color any_color(Random& random) {
  const auto any = [&] { return static_cast<std::uint8_t>(random.below(256)); };
  const std::uint8_t r = any(), g = any();
  return {r, g, any()};
}

void scatter(TestPolygon& polygon, Random& random) {
  for (ScreenVertex& v : polygon) {
    const Color c = any_color(random);
    v.r = c[0], v.g = c[1], v.b = c[2];
  }
}

void put_cells(CorpusBuilder& b, const std::string& name, const std::string& purpose, std::uint64_t count,
               const std::function<TestPolygon(Random&, int)>& make) {
  for (std::uint64_t i = 0; i < count; ++i) {
    Random random = b.random(name);
    b.add(name, CaseKind::picture, purpose, in_cells([&](int cell) { return make(random, cell); }));
    b.seeded();
  }
}

}  // namespace

void add_color(std::vector<Case>& corpus, const CorpusOptions& options) {
  CorpusBuilder b(corpus, options, "colour");
  put_cells(b, "flat", "Triangles of one colour: exactly that colour.", b.times(1), [](Random& random, int) {
    TestPolygon t = random_triangle(random, 28, 28);
    paint(t, any_color(random));
    return t;
  });
  for (std::uint64_t i = 0; i < b.times(2); ++i) {
    Random random = b.random("affine");
    Drawing drawing = in_cells([&](int) { return random_triangle(random, 30, 30); });
    for (TestPolygon& t : drawing.polygons) {
      set_plane(t, Attribute::r, 1, 0, 0), set_plane(t, Attribute::g, 0, 1, 0);
      set_plane(t, Attribute::b, -1, 0, 255);
    }
    b.add("affine", CaseKind::picture, "Red is x, green is y, blue 255 - x: whole numbers at every pixel.",
          drawing);
    b.seeded();
  }
  put_cells(b, "primary", "One pure colour at each corner.", b.times(1), [](Random& random, int cell) {
    TestPolygon t = random_triangle(random, 30, 30);
    for (int k = 0; k < 3; ++k) {
      const int channel = (k + cell) % 3;
      set_value(t[static_cast<std::size_t>(k)], k_channels[static_cast<std::size_t>(channel)], 255);
    }
    return t;
  });
  put_cells(b, "extremes", "Corners at 0 and at the largest value.", b.times(1), [](Random& random, int) {
    TestPolygon t = random_triangle(random, 30, 30);
    for (ScreenVertex& v : t) {
      v.r = random.below(2) == 0 ? 0 : 255, v.g = random.below(2) == 0 ? 0 : 255,
      v.b = random.below(2) == 0 ? 0 : 255;
    }
    return t;
  });
  put_cells(b, "frac", "Triangles with any colours at their corners.", b.times(3), [](Random& random, int) {
    TestPolygon t = random_triangle(random, 30, 30);
    scatter(t, random);
    return t;
  });
  for (std::uint64_t i = 0; i < b.times(1); ++i) {
    Random random = b.random("frac");
    TestPolygon t = polygon_of({{3, 2}, {250, 60}, {90, 253}});
    scatter(t, random);
    set_depth(t, 100);
    b.add("frac", CaseKind::picture, "A large triangle with any colours at its corners.", {k_f256, {t}});
    b.seeded();
  }
  put_cells(b, "ngon-affine", "Polygons, convex and concave, whose colours lie on a plane.", b.times(2),
            [](Random& random, int) {
              TestPolygon p = polygon_of(random_simple_polygon(random, random.between(4, 9), 30, 30));
              for (const Attribute a : k_channels) {
                const int u = random.between(-3, 3), v = random.between(-3, 3);
                set_plane(p, a, u, v, 128 - 15 * (u + v));
              }
              return p;
            });
  for (int quarter = 0; quarter < 2; ++quarter) {
    Drawing drawing = in_cells([&](int cell) {
      Random random("colour/ngon-free", static_cast<std::uint64_t>(cell), 1);
      TestPolygon quad;
      do {
        Points ring;
        for (const Point& p : {Point{0, 0}, Point{20, 0}, Point{20, 20}, Point{0, 20}})
          ring.push_back({p.x + random.between(0, 9), p.y + random.between(0, 9)});
        if (quarter == 1) {
          for (Point& p : ring) p = {29 - p.y, p.x};
        }
        quad = polygon_of(ring);
      } while (false);
      scatter(quad, random);
      return quad;
    });
    b.add("ngon-free", CaseKind::picture,
          "Quadrilaterals with any colours: by scan line or by triangles, within the corners' values.",
          drawing)
        .free_interpolation = true;
  }
  Random random("colour/vertex-order", 0, 1);
  for (int i = 0; i < 4; ++i) {
    TestPolygon t = random_triangle(random, 64, 64);
    scatter(t, random);
    set_depth(t, 100);
    Case& c =
        b.add("vertex-order", CaseKind::picture, "The same triangle from every corner, in both directions.");
    for (std::size_t first = 0; first < 3; ++first) {
      c.drawings.push_back({k_f64, {starting_at(t, first)}});
      c.drawings.push_back({k_f64, {reversed(starting_at(t, first))}});
    }
  }
  for (const int cres : {2, 64, 128}) {
    Random any("colour/cres", static_cast<std::uint64_t>(cres), 1);
    Drawing drawing{{64, 64, 512, cres}, {}};
    TestPolygon t = polygon_of({{3, 2}, {60, 20}, {25, 60}});
    for (ScreenVertex& v : t) {
      for (const Attribute a : k_channels) set_value(v, a, any.between(0, cres - 1));
    }
    set_depth(t, 100);
    drawing.polygons = {t};
    b.add("cres", CaseKind::picture, fmt::format("A colour resolution of {}.", cres), drawing);
  }
  for (int i = 0; i < 6; ++i) {
    // A screen hides the left part, the right part, the middle, or a slanted piece of a ramp.
    TestPolygon ramp = i < 3 ? rectangle(4, 8, 60, 56) : polygon_of({{4, 8}, {60, 14}, {30, 60}});
    set_plane(ramp, Attribute::r, 4, 0, 0), set_plane(ramp, Attribute::g, 0, 3, 20),
        set_plane(ramp, Attribute::b, -2, -2, 255);
    set_depth(ramp, 300);
    TestPolygon screen = i % 3 == 0   ? rectangle(2, 4, 30, 60)
                         : i % 3 == 1 ? rectangle(20, 4, 40, 60)
                                      : polygon_of({{2, 2}, {40, 10}, {20, 62}});
    paint(screen, {7, 9, 251});
    set_depth(screen, 50);
    Case& c = b.add("visible-span", CaseKind::picture, "A ramp of colours that is partly hidden.");
    c.drawings.push_back({k_f64, {ramp, screen}});
    c.drawings.push_back({k_f64, {screen, ramp}});
  }
}

}  // namespace farop::conformance
