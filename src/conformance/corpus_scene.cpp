// SPDX-License-Identifier: GPL-3.0-or-later
// Family `scene` (pictures of whole scenes) and what `meta` asks of them. Depths are the scene's own, so
// relations give every polygon one colour and compare only where the depths leave no choice.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "conformance/corpus_builder.h"

namespace farop::conformance {
namespace {

/// The scene with each polygon in a colour of its own.
Drawing painted(Drawing drawing) {
  for (std::size_t i = 0; i < drawing.polygons.size(); ++i)
    paint(drawing.polygons[i], identification_color(i));
  return drawing;
}

Drawing moved_in(Drawing drawing, int dx, int dy, int more) {
  for (TestPolygon& p : drawing.polygons) p = moved(std::move(p), dx, dy);
  drawing.frame.x += more, drawing.frame.y += more;
  return drawing;
}

/// From other corners, every second one in the other direction.
Drawing relisted(Drawing drawing, Random random) {
  for (std::size_t i = 0; i < drawing.polygons.size(); ++i) {
    TestPolygon& p = drawing.polygons[i];
    if (i % 2 == 1) p = reversed(std::move(p));
    const std::size_t first = random.below(p.size());
    p = starting_at(std::move(p), first);
  }
  return drawing;
}

/// Lattice points of edges become corners, their depths rounded; at most eight an edge.
Drawing with_more_corners(Drawing drawing) {
  for (TestPolygon& p : drawing.polygons) {
    TestPolygon more;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const ScreenVertex &a = p[i], &b = p[(i + 1) % p.size()];
      const int points = std::max(1, std::gcd(b.x - a.x, b.y - a.y));
      const int steps = std::gcd(points, 2 * 2 * 2);
      for (int k = 0; k < steps; ++k) {
        ScreenVertex& v = more.emplace_back(a);
        v.x += k * ((b.x - a.x) / steps), v.y += k * ((b.y - a.y) / steps);
        v.z += static_cast<std::int32_t>(k * (std::int64_t{b.z} - a.z) / steps);
      }
    }
    p = std::move(more);
  }
  return drawing;
}

/// Polygons of more than three corners cut along diagonals, where rounding has left them simple.
Drawing cut(const Drawing& drawing) {
  Drawing parts{drawing.frame, {}};
  for (const TestPolygon& p : drawing.polygons) {
    Points ring;
    for (const ScreenVertex& v : p) ring.push_back({v.x, v.y});
    if (p.size() == 3 || twice_area(p) <= 0 || !is_simple(ring)) {
      parts.polygons.push_back(p);
      continue;
    }
    for (const auto& t : triangulated(ring)) {
      TestPolygon& piece = parts.polygons.emplace_back();
      for (const int k : t) piece.push_back(p[static_cast<std::size_t>(k)]);
    }
  }
  return parts;
}

/// A copy of every tenth polygon, 16 farther away and in another colour, at the end.
Drawing with_hidden_ones(Drawing drawing) {
  const std::size_t count = drawing.polygons.size();
  for (std::size_t i = 0; i < count; i += 10) {
    TestPolygon behind = drawing.polygons[i];
    const auto farthest = std::ranges::max(behind, {}, &ScreenVertex::z).z;
    if (farthest + 16 >= drawing.frame.z) continue;
    for (ScreenVertex& v : behind) v.z += 16;
    paint(behind, identification_color(i + 1));
    drawing.polygons.push_back(std::move(behind));
  }
  return drawing;
}

Drawing in_other_order(Drawing drawing) {
  std::ranges::reverse(drawing.polygons);
  return drawing;
}

}  // namespace

void add_scenes(std::vector<Case>& corpus, const CorpusOptions& options) {
  CorpusBuilder scenes(corpus, options, "scene"), relations(corpus, options, "meta");
  for (const SceneSource& source : options.scenes) {
    Case& c = scenes.add(source.name, CaseKind::picture, source.purpose);
    c.index = source.index, c.expect_nothing_ambiguous = false;
    c.deliver = [draw = source.draw] { return std::vector{draw()}; };
  }
  for (const SceneSource& source : options.scenes) {
    if (!source.with_relations) continue;
    using Change = std::function<Drawing(const Drawing&)>;
    const auto put = [&](const char* name, const char* what, Change change) -> Case& {
      Case& c = relations.add(std::string("scene-") + name, CaseKind::relation,
                              fmt::format("The scene {}, {}.", source.name, what));
      c.decided_only = true, c.expect_nothing_ambiguous = false;
      c.deliver = [draw = source.draw, change = std::move(change)] {
        Drawing plain = painted(draw());
        Drawing other = change(plain);
        return std::vector{std::move(plain), std::move(other)};
      };
      return c;
    };
    Random random = relations.random("scene-translate");
    const int dx = random.between(1, 16), dy = random.between(1, 16);
    Case& shifted = put("translate", "moved by whole pixels in a larger frame",
                        [dx, dy](const Drawing& d) { return moved_in(d, dx, dy, 16); });
    shifted.shift_x = dx, shifted.shift_y = dy;
    relations.seeded();
    const Random corners = relations.random("scene-vertices");
    put("vertices", "its polygons listed from other corners and in the other direction",
        [corners](const Drawing& d) { return relisted(d, corners); });
    relations.seeded();
    put("edge-points", "with lattice points of the edges as corners", with_more_corners);
    put("split", "its polygons cut along their diagonals", cut);
    put("order", "its polygons in the opposite order", in_other_order);
    put("hidden", "with polygons behind others that change nothing", with_hidden_ones);
    put("crop", "in a larger frame", [](const Drawing& d) { return moved_in(d, 0, 0, 57); });
    Case& twice = put("twice", "drawn again after an empty frame", {});
    twice.kind = CaseKind::state;
    twice.deliver = [draw = source.draw] {
      const Drawing plain = draw();
      return std::vector{plain, Drawing{plain.frame, {}}, plain};
    };
  }
}

}  // namespace farop::conformance
