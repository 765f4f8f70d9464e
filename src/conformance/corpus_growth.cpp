// SPDX-License-Identifier: GPL-3.0-or-later
// Family perf: drawings of six sizes over a factor of 32.
#include <array>
#include <cmath>

#include "conformance/corpus_builder.h"

namespace farop::conformance {
namespace {

constexpr std::array k_factors = {1, 2, 4, 8, 16, 32};

Case& grows(CorpusBuilder& b, const char* name, const char* unit, double limit, std::string purpose) {
  Case& c = b.add(name, CaseKind::growth, std::move(purpose));
  c.expect_nothing_ambiguous = false;
  c.unit = unit, c.growth_limit = limit;
  return c;
}

void add_size(Case& c, double size, Drawing drawing) {
  c.sizes.push_back(size);
  c.drawings.push_back(std::move(drawing));
}

/// Triangles that cover four pixels or so each, side by side in a square of 255 x 255 or less, again and
/// again.
std::vector<TestPolygon> small_triangles(int count, int width) {
  std::vector<TestPolygon> triangles;
  const int columns = width / 5, rows = width / 3;
  for (int i = 0; i < count; ++i) {
    const int x = 5 * (i % columns), y = 3 * (i / columns % rows);
    triangles.push_back(polygon_of({{x, y}, {x + 4, y}, {x, y + 2}}));
  }
  return triangles;
}

/// A bar with a corner at every column, above and below.
TestPolygon bar_of_corners(int corners) {
  Points ring;
  for (int x = 0; x < corners / 2; ++x) ring.push_back({x, 0});
  for (int x = corners / 2 - 1; x >= 0; --x) ring.push_back({x, 9});
  return polygon_of(ring);
}

}  // namespace

void add_growth(std::vector<Case>& corpus, const CorpusOptions& options) {
  CorpusBuilder b(corpus, options, "perf");
  // A third more for a frame twice as large would be three times as much for 32 times.
  Case& resolution = grows(b, "resolution", "pixels of the frame", std::log(3.0) / std::log(32.0),
                           "The frame grows and the polygons do not: what they take must not grow.");
  for (const int factor : k_factors) {
    const int side = static_cast<int>(64 * std::sqrt(factor));
    add_size(resolution, side * side, identified({side, side, 512, 256}, small_triangles(64, 63)));
  }
  Case& fill = grows(b, "fill", "pixels", 1.3, "The area of eight rectangles grows: so may the time.");
  const Resolution large{544, 544, 512, 256};
  for (const int factor : k_factors) {
    const int side = static_cast<int>(96 * std::sqrt(factor));
    add_size(fill, 8.0 * side * side, identified(large, std::vector(8, rectangle(0, 0, side, side))));
  }
  Case& setup = grows(b, "setup", "polygons", 1.3, "The number of tiny polygons grows: so may the time.");
  for (const int factor : k_factors)
    add_size(setup, 256 * factor, identified(k_f256, small_triangles(256 * factor, 255)));
  Case& vertices = grows(b, "vertices", "corners", 1.5, "One polygon gets more corners, in as many rows.");
  const Resolution wide{10240, 12, 512, 256};
  for (const int factor : k_factors)
    add_size(vertices, 320 * factor, identified(wide, {bar_of_corners(320 * factor)}));
  Case& depth = grows(b, "depth", "layers", 1.3,
                      "Up to 10,000 layers lie over each other: the time may grow with them.");
  for (const int factor : k_factors) {
    Drawing layers = identified({20, 20, 65536, 256},
                                std::vector(320 * static_cast<std::size_t>(factor), rectangle(2, 2, 18, 18)));
    for (std::size_t i = 0; i < layers.polygons.size(); ++i)
      set_depth(layers.polygons[i], static_cast<std::int64_t>(1 + i * 40503 % 65535));
    add_size(depth, 320 * factor, std::move(layers));
  }
  Case& active = grows(b, "active", "edges in a row", 1.5, "More and more edges cross every row.");
  for (const int factor : k_factors)
    add_size(active, 320 * factor, identified(wide, {polygon_of(double_comb(160 * factor))}));
}

}  // namespace farop::conformance
