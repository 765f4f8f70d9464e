// SPDX-License-Identifier: GPL-3.0-or-later
// What the families of the corpus share. For src/conformance/corpus*.cpp.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "conformance/attribute.h"
#include "conformance/corpus.h"
#include "conformance/random.h"
#include "conformance/shapes.h"

namespace farop::conformance {

inline constexpr Resolution k_f64{64, 64, 512, 256}, k_f256{256, 256, 512, 256}, k_f512{512, 512, 512, 256},
    k_f1k{1024, 1024, 65536, 256};

/// Collects cases and numbers them.
class CorpusBuilder {
 public:
  CorpusBuilder(std::vector<Case>& corpus, const CorpusOptions& options, std::string family)
      : corpus_(corpus), options_(options), family_(std::move(family)) {}

  Level level() const { return options_.level; }
  /// `count` cases by default, 50 times as many when thorough.
  std::uint64_t times(std::uint64_t count) const { return level() == Level::thorough ? 50 * count : count; }
  std::uint64_t seed() const { return options_.seed; }

  /// An exhaustive case: the same whatever the seed.
  Case& add(const std::string& name, CaseKind kind, std::string purpose) {
    Case& added = corpus_.emplace_back();
    added.family = family_;
    added.name = name;
    added.index = next_[name]++;
    added.purpose = std::move(purpose);
    added.kind = kind;
    return added;
  }
  Case& add(const std::string& name, CaseKind kind, std::string purpose, Drawing drawing) {
    Case& added = add(name, kind, std::move(purpose));
    added.drawings.push_back(std::move(drawing));
    return added;
  }
  /// Numbers of the next case of that name.
  Random random(const std::string& name) { return {family_ + "/" + name, next_[name], options_.seed}; }
  /// Marks the last case as one that the seed has chosen.
  void seeded() { corpus_.back().seed = options_.seed; }

 private:
  std::vector<Case>& corpus_;
  const CorpusOptions& options_;
  std::string family_;
  std::map<std::string, std::uint64_t> next_;
};

/// All polygons in identification colours at one depth.
inline Drawing identified(const Resolution& frame, std::vector<TestPolygon> polygons, std::int64_t z = 100) {
  Drawing drawing{frame, std::move(polygons)};
  for (std::size_t i = 0; i < drawing.polygons.size(); ++i) {
    paint(drawing.polygons[i], identification_color(i));
    set_depth(drawing.polygons[i], z);
  }
  return drawing;
}

inline Points random_points(Random& random, int count, int width, int height) {
  Points points;
  for (int i = 0; i < count; ++i)
    points.push_back({random.between(0, width - 1), random.between(0, height - 1)});
  return points;
}

/// A triangle with area.
inline TestPolygon random_triangle(Random& random, int width, int height) {
  while (true) {
    TestPolygon t = polygon_of(random_points(random, 3, width, height));
    if (twice_area(t) != 0) return turned_left(std::move(t));
  }
}

/// value = a x + b y + c.
inline void set_plane(TestPolygon& polygon, Attribute attribute, std::int64_t a, std::int64_t b,
                      std::int64_t c) {
  for (ScreenVertex& v : polygon) set_value(v, attribute, a * v.x + b * v.y + c);
}

void add_smoke(std::vector<Case>& corpus, const CorpusOptions& options);
void add_coverage(std::vector<Case>& corpus, const CorpusOptions& options);
void add_tilings(std::vector<Case>& corpus, const CorpusOptions& options);
void add_depth(std::vector<Case>& corpus, const CorpusOptions& options);
void add_color(std::vector<Case>& corpus, const CorpusOptions& options);
void add_relations(std::vector<Case>& corpus, const CorpusOptions& options);
void add_state_and_repeats(std::vector<Case>& corpus, const CorpusOptions& options);
void add_growth(std::vector<Case>& corpus, const CorpusOptions& options);
/// Families `scene`, and the relations of scenes in `meta`.
void add_scenes(std::vector<Case>& corpus, const CorpusOptions& options);
void add_beyond_contract(std::vector<Case>& corpus, const CorpusOptions& options);

}  // namespace farop::conformance
