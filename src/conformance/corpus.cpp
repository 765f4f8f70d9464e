// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/corpus.h"

#include <fmt/format.h>

#include <string_view>

#include "conformance/corpus_builder.h"

namespace farop::conformance {

std::string Case::id() const {
  return fmt::format("{}/{}#{}@{}", family, name, index, seed);
}

Color identification_color(std::size_t number) {
  // Red and green are 4 modulo 8, the backgrounds 0 modulo 8.
  return {static_cast<std::uint8_t>(8 * (number * 13 % 32) + 4),
          static_cast<std::uint8_t>(8 * (number / 32 * 7 % 32) + 4),
          static_cast<std::uint8_t>(16 * ((number * 5 + number / 1024) % 16) + 8)};
}

const std::vector<FamilyFacts>& corpus_families() {
  static const std::vector<FamilyFacts> families = {
      {"smoke", "does it draw at all, the right way round, in the right colours"},
      {"regress", "what others got wrong before"},
      {"cov", "which samples one polygon covers"},
      {"tile", "polygons that share edges: every sample once"},
      {"depth", "who is in front, and how deep it is"},
      {"colour", "colours across a polygon"},
      {"meta", "pictures that must equal each other"},
      {"abi", "several frames and sizes in one life"},
      {"det", "the same again, in other memory"},
      {"mem", "beside the memory that is given"},
      {"scene", "whole scenes, as polygons and as triangles"},
      {"perf", "how the time grows"},
      {"x", "outside the contract: only crashes count"}};
  return families;
}

std::vector<Case> make_corpus(const CorpusOptions& options) {
  std::vector<Case> corpus;
  add_smoke(corpus, options);
  add_coverage(corpus, options);
  if (options.level != Level::quick) {
    add_tilings(corpus, options);
    add_depth(corpus, options);
    add_color(corpus, options);
    add_relations(corpus, options);
    add_state_and_repeats(corpus, options);
    add_growth(corpus, options);
  }
  if (options.level != Level::quick) add_scenes(corpus, options);
  if (options.beyond_contract) add_beyond_contract(corpus, options);
  return corpus;
}

std::uint64_t corpus_hash(const std::vector<Case>& corpus) {
  std::uint64_t hash = k_fnv_offset;
  // Byte by byte, lowest first, so that the machine's own order does not matter.
  const auto number = [&hash](std::int64_t value) {
    for (int shift = 0; shift < 64; shift += 8)
      hash = (hash ^ (static_cast<std::uint64_t>(value) >> shift & 0xFFu)) * 0x100000001B3u;
  };
  for (const Case& c : corpus) {
    hash = fnv1a(c.id(), hash);
    number(static_cast<std::int64_t>(c.kind));
    for (const Drawing& d : c.drawings) {
      number(d.frame.x), number(d.frame.y), number(d.frame.z), number(d.frame.color);
      for (const TestPolygon& polygon : d.polygons) {
        number(static_cast<std::int64_t>(polygon.size()));
        for (const ScreenVertex& v : polygon) {
          number(v.x), number(v.y), number(v.z), number(v.r), number(v.g), number(v.b);
        }
      }
    }
  }
  return hash;
}

void add_smoke(std::vector<Case>& corpus, const CorpusOptions& options) {
  CorpusBuilder b(corpus, options, "smoke");
  b.add("empty", CaseKind::picture, "No polygon: the background stays as it was.", {k_f64, {}});

  TestPolygon quad = rectangle(16, 16, 48, 40);
  paint(quad, {96, 64, 32});
  set_depth(quad, 100);
  b.add("quad", CaseKind::picture, "A rectangle of 32 x 24 pixels in one colour.", {k_f64, {quad}});

  TestPolygon letter = polygon_of(
      {{8, 8}, {16, 8}, {16, 28}, {32, 28}, {32, 36}, {16, 36}, {16, 48}, {40, 48}, {40, 56}, {8, 56}});
  paint(letter, {200, 80, 40});
  set_depth(letter, 100);
  b.add("letter-F", CaseKind::picture, "An F, which looks otherwise when flipped, turned or taken as convex.",
        {k_f64, {letter}});

  TestPolygon first = polygon_of({{40, 100}, {50, 80}, {60, 50}});
  TestPolygon second = polygon_of({{40, 40}, {50, 110}, {60, 50}, {55, 60}});
  paint(first, {128, 30, 128});
  paint(second, {128, 30, 128});
  set_depth(first, 89);
  set_depth(second, 89);
  b.add("paper", CaseKind::picture, "The two records that the 1997 paper prints.", {k_f512, {first, second}})
      .expect_nothing_ambiguous = false;

  TestPolygon lecture = polygon_of({{0, 1}, {2, 8}, {4, 6}, {7, 8}, {9, 4}, {6, 1}});
  paint(lecture, {40, 200, 120});
  set_depth(lecture, 100);
  b.add("lecture", CaseKind::picture, "The polygon of the lecture's example: 43 pixels by hand.",
        {k_f64, {lecture}});
}

void add_beyond_contract(std::vector<Case>& corpus, const CorpusOptions& options) {
  CorpusBuilder b(corpus, options, "x");
  b.add("bow-tie", CaseKind::survive, "A polygon that crosses itself.",
        identified(k_f64, {polygon_of({{8, 8}, {56, 56}, {56, 8}, {8, 56}})}));
  for (const int far : {-1, 64, 1 << 15, -(1 << 15), 1 << 20, -(1 << 20), 1 << 30, -(1 << 30)}) {
    b.add("outside", CaseKind::survive, fmt::format("A corner at column and row {}.", far),
          identified(k_f64, {polygon_of({{10, 10}, {50, 12}, {far, far}})}));
  }
}

}  // namespace farop::conformance
