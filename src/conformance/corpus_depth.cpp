// SPDX-License-Identifier: GPL-3.0-or-later
// Family `depth`: who is in front, and how deep it is. All polygons are flat or planar on the lattice.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "conformance/corpus_builder.h"
#include "conformance/expectation.h"

namespace farop::conformance {
namespace {

/// Every order of up to 4 polygons; of more the given one, its reverse and 22 random ones.
std::vector<Drawing> in_orders(const Drawing& drawing, Random random) {
  std::vector<std::size_t> order(drawing.polygons.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<Drawing> drawings;
  const auto put = [&] {
    Drawing next{drawing.frame, {}};
    for (const std::size_t i : order) next.polygons.push_back(drawing.polygons[i]);
    drawings.push_back(std::move(next));
  };
  if (order.size() <= 4) {
    do put();
    while (std::ranges::next_permutation(order).found);
    return drawings;
  }
  put();
  std::ranges::reverse(order);
  put();
  while (drawings.size() < 24) {
    random.shuffle(order);
    put();
  }
  return drawings;
}

/// Identification colours; depths as they are.
Drawing scene(const Resolution& frame, std::vector<TestPolygon> polygons) {
  Drawing drawing{frame, std::move(polygons)};
  for (std::size_t i = 0; i < drawing.polygons.size(); ++i)
    paint(drawing.polygons[i], identification_color(i));
  return drawing;
}

TestPolygon flat(TestPolygon polygon, std::int64_t z) {
  set_depth(polygon, z);
  return polygon;
}

TestPolygon sloped(TestPolygon polygon, std::int64_t a, std::int64_t b, std::int64_t c) {
  set_plane(polygon, Attribute::z, a, b, c);
  return polygon;
}

void put_orders(CorpusBuilder& b, const std::string& name, std::string purpose, const Drawing& drawing) {
  const Random random = b.random(name);
  b.add(name, CaseKind::picture, std::move(purpose)).drawings = in_orders(drawing, random);
  if (drawing.polygons.size() > 4) b.seeded();  // the orders are random ones
}

void add_measured(CorpusBuilder& b) {
  const std::array<std::array<std::int64_t, 3>, 6> planes = {
      {{7, 1, 3}, {1, 7, 3}, {-7, 1, 444}, {1, -7, 444}, {-7, -1, 508}, {3, -4, 255}}};
  for (const auto& [a, c, o] : planes) {
    for (const Points& ring : {Points{{2, 2}, {61, 10}, {30, 60}}, Points{{5, 60}, {3, 20}, {60, 3}}}) {
      b.add("slope", CaseKind::probe, "A plane whose depth is a whole number at every pixel, measured there.",
            scene(k_f64, {sloped(turned_left(polygon_of(ring)), a, c, o)}));
    }
  }
  for (std::uint64_t i = 0; i < b.times(16); ++i) {
    Random random = b.random("frac");
    TestPolygon t = random_triangle(random, 64, 64);
    for (ScreenVertex& v : t) v.z = random.between(0, 511);
    b.add("frac", CaseKind::probe, "A random triangle with any depths, measured at every pixel.",
          scene(k_f64, {t}));
    b.seeded();
  }
  const Resolution deep{64, 64, 65536, 256};
  for (const int slope : {60, -60}) {
    const TestPolygon t = turned_left(polygon_of({{4, 4}, {58, 20}, {25, 60}}));
    const std::int64_t c = slope > 0 ? 1000 : 6000;
    b.add("steep", CaseKind::probe, "A steep slope behind a slanted left edge, measured at every pixel.",
          scene(deep, {sloped(t, slope, 0, c)}));
    for (const int gap : {30, -30}) {
      put_orders(b, "steep", "A steep slope, and another one half a pixel's step in front or behind.",
                 scene(deep, {sloped(t, slope, 0, c), sloped(rectangle(2, 2, 62, 62), slope, 0, c + gap)}));
    }
  }
  for (const std::int64_t z : {std::int64_t{2}, std::int64_t{512}, std::int64_t{65536}, std::int64_t{1} << 24,
                               std::int64_t{1} << 30}) {
    const Resolution wide{1024, 48, z, 256};
    TestPolygon t = polygon_of({{1, 1}, {1022, 5}, {500, 46}});
    if (z > 2) t[0].z = static_cast<std::int32_t>(z - 1), t[2].z = static_cast<std::int32_t>(z / 3);
    b.add("zres", CaseKind::probe, fmt::format("Depths 0 to {} over a wide triangle.", z - 1),
          scene(wide, {t}));
    if (z > 2)
      t[0].z = 0, t[1].z = static_cast<std::int32_t>(z - 1), t[2].z = static_cast<std::int32_t>(z / 2);
    b.add("zres", CaseKind::probe, fmt::format("Depths 0 to {} over a wide triangle.", z - 1),
          scene(wide, {t}));
  }
  for (const bool far_last : {true, false}) {
    std::vector<TestPolygon> two = {flat(rectangle(8, 8, 40, 40), 100), flat(rectangle(8, 8, 40, 40), 300)};
    if (!far_last) std::swap(two[0], two[1]);
    b.add("write", CaseKind::probe, "What loses the depth test must not leave its depth; what wins must.",
          scene(k_f64, two));
  }
}

void add_visible(CorpusBuilder& b) {
  put_orders(b, "two", "Two squares that overlap, one nearer.",
             scene(k_f64, {flat(rectangle(8, 8, 40, 40), 100), flat(rectangle(24, 24, 56, 56), 200)}));
  put_orders(b, "range", "Depth 0 is in front of everything.",
             scene(k_f64, {flat(rectangle(8, 8, 40, 40), 0), flat(rectangle(24, 24, 56, 56), 1),
                           flat(rectangle(4, 30, 60, 34), 511)}));
  put_orders(b, "range", "A polygon at the farthest depth is in front of the background.",
             scene(k_f64, {flat(rectangle(8, 8, 56, 56), 511)}));

  put_orders(
      b, "cross", "Two planes that pass through each other between columns.",
      scene(k_f64, {sloped(rectangle(8, 8, 56, 56), 8, 0, 36), sloped(rectangle(8, 8, 56, 56), -8, 0, 540)}));
  put_orders(
      b, "cross", "Two planes that pass through each other between rows.",
      scene(k_f64, {sloped(rectangle(8, 8, 56, 56), 0, 8, 36), sloped(rectangle(8, 8, 56, 56), 0, -8, 540)}));
  put_orders(b, "cross", "Two planes that pass through each other along a diagonal.",
             scene(k_f64, {sloped(rectangle(8, 8, 56, 56), 4, 4, 12),
                           sloped(rectangle(8, 8, 56, 56), -4, -4, 512)}));
  put_orders(b, "cross", "Two triangles that pass through each other along a slanted line.",
             scene(k_f64, {sloped(polygon_of({{4, 4}, {60, 10}, {20, 58}}), 4, 2, 30),
                           sloped(polygon_of({{60, 4}, {50, 60}, {4, 40}}), -4, -2, 412)}));
  put_orders(
      b, "cross", "Three planes that pass through each other.",
      scene(k_f64, {sloped(rectangle(8, 8, 56, 56), 6, 0, 20), sloped(rectangle(4, 20, 60, 44), -6, 0, 410),
                    flat(rectangle(12, 12, 52, 40), 209)}));

  put_orders(
      b, "cycle", "Four bars in a ring, each over the next: no order of drawing is right.",
      scene(k_f64,
            {sloped(rectangle(8, 8, 56, 16), 5, 0, 24), sloped(rectangle(48, 8, 56, 56), 0, 5, 24),
             sloped(rectangle(8, 48, 56, 56), -5, 0, 344), sloped(rectangle(8, 8, 16, 56), 0, -5, 344)}));

  for (const int count : {2, 3, 4, 8, 16}) {
    for (int kind = 0; kind < 4; ++kind) {  // nearer inside, outside, equal left edges, same first row
      std::vector<TestPolygon> squares;
      for (int i = 0; i < count; ++i) {
        const int in = i * (28 / count) + 2;
        const int z = kind == 1 ? 20 + 30 * i : 500 - 30 * i;
        TestPolygon square = kind == 2   ? rectangle(2, in, 62 - in, 62 - in)
                             : kind == 3 ? rectangle(in, 2, 62 - in, 62 - in)
                                         : rectangle(in, in, 62 - in, 62 - in);
        squares.push_back(flat(square, z));
      }
      put_orders(b, "nested", "Squares in squares, nearer inside or outside, with edges in common.",
                 scene(k_f64, squares));
    }
  }
  std::vector<TestPolygon> layers;
  for (int i = 0; i < 256; ++i) layers.push_back(flat(rectangle(10, 10, 30, 18), 2 * i));
  Drawing stack = scene(k_f64, layers);
  Case& c = b.add("layers", CaseKind::picture, "256 layers, front to back, back to front, shuffled.");
  c.drawings.push_back(stack);
  std::ranges::reverse(stack.polygons);
  c.drawings.push_back(stack);
  Random("depth/layers", 0, 1).shuffle(stack.polygons);
  c.drawings.push_back(stack);
  std::vector<TestPolygon> moving;
  for (int i = 0; i < 24; ++i)
    moving.push_back(flat(rectangle(2 + i, 4 + i % 5, 30 + i, 40 + i % 7), 20 * ((i * 7) % 24)));
  put_orders(b, "layers", "Layers that begin and end at different columns and rows.", scene(k_f64, moving));

  std::vector<TestPolygon> hidden = {flat(rectangle(8, 8, 56, 56), 10)};
  Random random("depth/hidden", 0, 1);
  for (int i = 0; i < 50; ++i) {
    const int x = random.between(8, 40), y = random.between(8, 40);
    hidden.push_back(flat(rectangle(x, y, x + random.between(2, 16), y + random.between(2, 16)), 50 + 9 * i));
  }
  put_orders(b, "hidden", "One near polygon hides fifty far ones.", scene(k_f64, hidden));

  for (std::uint64_t i = 0; i < b.times(4); ++i) {
    Random any = b.random("order");
    std::vector<TestPolygon> triangles;
    for (int k = 0; k < 12; ++k) {
      TestPolygon t = random_triangle(any, 64, 64);
      // Each has a slab of depths for itself.
      for (ScreenVertex& v : t) v.z = 40 * k + 4 + any.between(0, 30);
      triangles.push_back(t);
    }
    put_orders(b, "order", "Random triangles at different depths: one picture whatever the order.",
               scene(k_f64, triangles));
    b.seeded();
  }
}

void add_ties(CorpusBuilder& b) {
  const auto put = [&b](const Drawing& drawing) {
    Case& c = b.add("ties", CaseKind::ties, "Equal depths: the first or the last wins, everywhere the same.");
    c.expect_nothing_ambiguous = false;
    c.drawings = {drawing, drawing};
    std::ranges::reverse(c.drawings.back().polygons);
  };
  put(scene(k_f64, {flat(rectangle(8, 8, 40, 40), 200), flat(rectangle(24, 24, 56, 56), 200)}));
  put(scene(k_f64,
            {flat(polygon_of({{4, 4}, {60, 20}, {20, 60}}), 77), flat(rectangle(10, 10, 40, 50), 77)}));
  // A decal on a slope; whole numbers at every pixel, so that both planes give the same there.
  put(scene(k_f64, {sloped(rectangle(4, 4, 60, 60), 4, 2, 10), sloped(rectangle(20, 20, 40, 40), 4, 2, 10)}));
}

}  // namespace

void add_depth(std::vector<Case>& corpus, const CorpusOptions& options) {
  CorpusBuilder b(corpus, options, "depth");
  add_visible(b);
  add_measured(b);
  add_ties(b);
}

}  // namespace farop::conformance
