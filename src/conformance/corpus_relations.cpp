// SPDX-License-Identifier: GPL-3.0-or-later
// Families `meta` (pictures that must equal each other), `abi` (frames in one life) and `det` (the same
// again). Colours and depths are constant, so that equal means bit by bit.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "conformance/corpus_builder.h"

namespace farop::conformance {
namespace {

Drawing some_scene(Random& random, const Resolution& frame, int count, int margin = 0) {
  std::vector<TestPolygon> polygons;
  for (int i = 0; i < count; ++i) {
    const int w = frame.x - 2 * margin, h = frame.y - 2 * margin;
    polygons.push_back(moved(i % 3 == 2
                                 ? polygon_of(random_simple_polygon(random, random.between(4, 9), w, h))
                                 : random_triangle(random, w, h),
                             margin, margin));
  }
  Drawing drawing = identified(frame, polygons);
  for (int i = 0; i < count; ++i)
    set_depth(drawing.polygons[static_cast<std::size_t>(i)], 20 + 480 * ((i * 7) % count) / count);
  return drawing;
}

/// Every lattice point of every edge becomes a corner.
TestPolygon with_edge_points(const TestPolygon& polygon) {
  TestPolygon more;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ScreenVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const int steps = std::max(1, std::gcd(b.x - a.x, b.y - a.y));
    for (int k = 0; k < steps; ++k) {
      more.push_back(a);
      more.back().x += k * ((b.x - a.x) / steps), more.back().y += k * ((b.y - a.y) / steps);
    }
  }
  return more;
}

}  // namespace

void add_relations(std::vector<Case>& corpus, const CorpusOptions& options) {
  CorpusBuilder b(corpus, options, "meta");
  const auto put = [&b](const std::string& name, const char* purpose, Drawing first,
                        Drawing second) -> Case& {
    Case& c = b.add(name, CaseKind::relation, purpose);
    c.window = window_of(first.frame);
    c.drawings = {std::move(first), std::move(second)};
    b.seeded();
    return c;
  };
  for (std::uint64_t i = 0; i < b.times(4); ++i) {
    Random random = b.random("translate");
    const Drawing plain = some_scene(random, k_f64, 6, 8);
    Drawing other = plain;
    const int dx = random.between(-8, 8), dy = random.between(-8, 8);
    for (TestPolygon& p : other.polygons) p = moved(p, dx, dy);
    Case& c = put("translate", "A scene moved by whole pixels.", plain, other);
    c.shift_x = dx, c.shift_y = dy;
    c.window = {8, 8, 56, 56};
  }
  for (std::uint64_t i = 0; i < b.times(4); ++i) {
    Random random = b.random("vertices");
    const Drawing plain = some_scene(random, k_f64, 6);
    Drawing other = plain;
    for (TestPolygon& p : other.polygons)
      p = starting_at(i % 2 == 0 ? reversed(p) : p, random.below(p.size()));
    put("vertices", "The same polygons, listed from other corners and in the other direction.", plain, other);
  }
  for (std::uint64_t i = 0; i < b.times(4); ++i) {
    Random random = b.random("edge-points");
    const Drawing plain = some_scene(random, k_f64, 6);
    Drawing other = plain;
    for (TestPolygon& p : other.polygons) p = with_edge_points(p);
    put("edge-points", "Lattice points of the edges become corners.", plain, other);
  }
  for (std::uint64_t i = 0; i < b.times(4); ++i) {
    Random random = b.random("split");
    const Points ring = random_simple_polygon(random, random.between(5, 10), 64, 64);
    Drawing whole = identified(k_f64, {polygon_of(ring)});
    Drawing parts{k_f64, {}};
    for (const auto& t : triangulated(ring)) {
      TestPolygon piece;
      for (const int k : t) piece.push_back(whole.polygons[0][static_cast<std::size_t>(k)]);
      parts.polygons.push_back(piece);
    }
    put("split", "A polygon cut along its diagonals.", whole, parts);
  }
  for (std::uint64_t i = 0; i < b.times(2); ++i) {
    Random random = b.random("swap");
    const TestPolygon left = random_triangle(random, 30, 64),
                      right = moved(random_triangle(random, 30, 64), 33, 0);
    const Drawing plain = identified(k_f64, {left, right});
    Drawing other = plain;
    std::swap(other.polygons[0], other.polygons[1]);
    put("swap", "Two polygons that do not touch, in the other order.", plain, other);
  }
  for (std::uint64_t i = 0; i < b.times(2); ++i) {
    Random random = b.random("hidden");
    Drawing plain = some_scene(random, k_f64, 5);
    TestPolygon screen = rectangle(0, 0, 63, 63);
    paint(screen, identification_color(100)), set_depth(screen, 5);
    plain.polygons.push_back(screen);
    Drawing other = plain;
    TestPolygon behind = random_triangle(random, 64, 64);
    paint(behind, identification_color(101)), set_depth(behind, 400);
    other.polygons.push_back(behind);
    put("hidden", "A polygon that is fully hidden changes nothing.", plain, other);
  }
  for (std::uint64_t i = 0; i < b.times(2); ++i) {
    Random random = b.random("crop");
    Drawing plain = some_scene(random, k_f64, 6);
    Drawing other = plain;
    other.frame = {200, 150, 512, 256};
    put("crop", "The same polygons in a larger frame.", plain, other);
  }
}

namespace {

void add_guarded(std::vector<Case>& corpus, const CorpusOptions& options) {
  CorpusBuilder b(corpus, options, "mem");
  Random random("mem", 0, options.seed);
  b.add("guard", CaseKind::guard,
        "Nothing may be read or written beside the frame and the corners, nor later.")
      .drawings = {some_scene(random, k_f64, 40),
                   some_scene(random, {17, 9, 512, 256}, 8),
                   identified(k_f64, {rectangle(0, 0, 63, 63), polygon_of({{63, 63}, {0, 63}, {63, 0}})}),
                   identified({204, 8, 512, 256}, {polygon_of(double_comb(100))}),
                   {k_f64, {}}};
  b.seeded();
  corpus.back().expect_nothing_ambiguous = false;
}

}  // namespace

void add_state_and_repeats(std::vector<Case>& corpus, const CorpusOptions& options) {
  {
    CorpusBuilder b(corpus, options, "abi");
    Random random("abi", 0, options.seed);
    const Drawing a = some_scene(random, k_f64, 6), c = some_scene(random, k_f64, 6);
    const Drawing empty{k_f64, {}};
    b.add("frames", CaseKind::state, "A frame, another one, and the first one again.").drawings = {a, c, a};
    b.seeded();
    b.add("empty", CaseKind::state, "A frame without polygons after and before others.").drawings = {
        a, empty, a, empty};
    b.seeded();
    Drawing small = some_scene(random, {17, 9, 512, 256}, 3),
            tall = some_scene(random, {20, 200, 512, 256}, 4),
            wide = some_scene(random, {300, 30, 65536, 256}, 4);
    b.add("sizes", CaseKind::state, "Frames of different sizes in one life.").drawings = {
        a, small, wide, a, tall, small, a};
    b.seeded();
    Points ring = {{0, 0}, {63, 0}};
    for (int i = 0; i < 20000 - 2; ++i) ring.push_back({63 - i * 63 / 20000, 40 + i % 2});
    // Zigzag along the top: neighbouring corners, so no edges cross but by running over each other.
    const Drawing many = identified(k_f64, {polygon_of(ring)});
    const Drawing three = identified(k_f64, {polygon_of({{4, 4}, {60, 10}, {30, 60}})});
    b.add("vertices", CaseKind::state, "Polygons of 3, then 20,000, then 3 corners.").drawings = {three, many,
                                                                                                  three};
  }
  add_guarded(corpus, options);
  CorpusBuilder b(corpus, options, "det");
  Random random("det", 0, options.seed);
  Case& c =
      b.add("repeat", CaseKind::repeat, "The same pictures again: in this life, in others, in other memory.");
  c.drawings.push_back({k_f64, {}});
  for (int i = 0; i < 6; ++i) c.drawings.push_back(some_scene(random, k_f64, 8));
  c.drawings.push_back(identified(k_f64, {rectangle(0, 0, 63, 63)}));
  c.drawings.push_back(some_scene(random, {256, 256, 65536, 256}, 40));
  TestPolygon ramp = polygon_of({{0, 0}, {255, 40}, {60, 255}});
  for (ScreenVertex& v : ramp)
    v.z = random.between(0, 511), v.r = 255, v.g = static_cast<std::uint16_t>(random.below(256));
  c.drawings.push_back({k_f256, {ramp}});
  c.drawings.push_back(identified(k_f256, random_mesh(random, 60, 256, 256)));
  b.seeded();
}

}  // namespace farop::conformance
