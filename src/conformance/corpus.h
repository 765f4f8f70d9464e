// SPDX-License-Identifier: GPL-3.0-or-later
// The cases that a rasterizer is tested with: generated, the same on every machine.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "conformance/drawing.h"

namespace farop::conformance {

enum class Level { quick, normal, thorough };

/// How the drawings of a case are judged.
enum class CaseKind : std::uint8_t {
  coverage,  ///< polygons in colours of their own, apart from each other: which samples does each draw
  picture,   ///< every drawing on its own: owner, depth order, colour
  tiling,    ///< one drawing whose polygons share edges: each sample once, whatever the order
  probe,     ///< depth of the first drawing's polygons measured at every sample
  ties,      ///< equal depths: first or last wins, the same everywhere
  relation,  ///< the second drawing, moved by `shift`, must equal the first within `window`
  state,     ///< drawn one after another in one life; equal drawings give equal pictures
  repeat,    ///< drawn in several processes and memories: bit-equal
  guard,     ///< drawn twice with guards around everything the rasterizer gets
  file,      ///< from a flat file: whatever can be judged
  growth,    ///< the same at several sizes: how the time grows
  survive    ///< outside the contract: must not crash or write outside
};

struct Case {
  std::string family, name;  ///< "cov", "tri4"
  std::uint64_t index = 0, seed = 1;
  std::string purpose;  ///< one sentence
  CaseKind kind = CaseKind::picture;
  bool tile = false;  ///< small enough for a tile of a sheet: corners 0..3
  bool expect_nothing_ambiguous = true;
  bool free_interpolation = false;  ///< n-gons with values on no plane: scan-line or any triangulation
  std::vector<Drawing> drawings;
  /// Makes `drawings` when their turn comes, where they are large: until then there are none.
  std::function<std::vector<Drawing>()> deliver;
  std::vector<double> sizes;  ///< of growth: what each drawing has of `unit`
  std::string unit;           ///< "corners"
  double growth_limit = 0;    ///< largest exponent of the growth that is nothing special
  /// Of a relation: only samples are compared where either picture is known to show one polygon.
  bool decided_only = false;
  Window window;  ///< of a relation
  int shift_x = 0, shift_y = 0;

  std::string id() const;
  std::string group() const { return family + "/" + name; }
};

/// A picture of a scene, made by whoever knows scenes: the polygons that its geometry stage hands over.
struct SceneSource {
  std::string name;             ///< "gears"
  std::uint64_t index = 0;      ///< which picture of that scene; the same at every level
  std::string purpose;          ///< one sentence
  bool with_relations = false;  ///< family `meta` has its relations, too
  std::function<Drawing()> draw;
};

struct CorpusOptions {
  Level level = Level::normal;
  std::uint64_t seed = 1;
  bool beyond_contract = false;
  std::vector<SceneSource> scenes = {};  ///< what the level has
};

/// Everything but `regress`, family by family (corpus_families(); x where asked for).
std::vector<Case> make_corpus(const CorpusOptions& options);

/// Families in order, with a word about each.
struct FamilyFacts {
  std::string_view name, purpose;
};
const std::vector<FamilyFacts>& corpus_families();

/// FNV-1a over ids and all numbers of all drawings that are there already.
std::uint64_t corpus_hash(const std::vector<Case>& corpus);

/// Colour by which polygon `number` is told from all others (16384 of them) and from both backgrounds.
Color identification_color(std::size_t number);
/// What frames are filled with before drawing, where that can be chosen; black in flat files.
constexpr Color k_background = {16, 16, 48};

}  // namespace farop::conformance
