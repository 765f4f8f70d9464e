// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/corpus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "conformance/expectation.h"
#include "conformance/shapes.h"

namespace farop::conformance {
namespace {

TEST(Corpus, HasTheNumbersOfTheLatticePolygons) {
  std::map<std::string, int> count;
  for (const Case& c : make_corpus({})) ++count[c.group()];
  EXPECT_EQ(count["cov/tri4"], 516 * 6);
  EXPECT_EQ(count["cov/quad4"], (1038 + 720) * 2);
  EXPECT_EQ(count["cov/tri-random"], 256 + 64);
  EXPECT_EQ(count["cov/unimodular"], 18);
  EXPECT_GT(count["cov/vertex-kinds"], 40);
}

TEST(Corpus, IsTheSameOnEveryMachine) {
  // gcc and clang, debug and release: whoever changes a case on purpose changes these.
  EXPECT_EQ(corpus_hash(make_corpus({Level::quick, 1, false})), 4760536807432556346u);
  EXPECT_EQ(corpus_hash(make_corpus({Level::normal, 1, false})), 9479600086904442832u);
}

TEST(Corpus, FollowsTheSeedWhereItIsRandom) {
  const auto one = make_corpus({Level::normal, 1, false}), two = make_corpus({Level::normal, 2, false});
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (one[i].seed == two[i].seed) {
      EXPECT_EQ(corpus_hash({one[i]}), corpus_hash({two[i]})) << one[i].id();
    } else {
      EXPECT_NE(corpus_hash({one[i]}), corpus_hash({two[i]})) << one[i].id();
    }
  }
}

TEST(Corpus, HasNamesThatAreUniqueAndSentencesAsReasons) {
  std::set<std::string> ids;
  for (const Case& c : make_corpus({Level::normal, 1, true})) {
    EXPECT_TRUE(ids.insert(c.id()).second) << c.id();
    EXPECT_TRUE(c.purpose.ends_with('.')) << c.id() << ": " << c.purpose;
    EXPECT_FALSE(c.drawings.empty()) << c.id();
  }
}

TEST(Corpus, KeepsTheContract) {
  for (const Case& c : make_corpus({})) {
    for (const Drawing& d : c.drawings) {
      for (const TestPolygon& p : d.polygons) {
        EXPECT_GE(p.size(), 3u) << c.id();
        for (const ScreenVertex& v : p) {
          ASSERT_TRUE(v.x >= 0 && v.x < d.frame.x && v.y >= 0 && v.y < d.frame.y) << c.id();
          ASSERT_TRUE(v.z >= 0 && v.z < d.frame.z) << c.id() << " z " << v.z;
          ASSERT_TRUE(v.r < d.frame.color && v.g < d.frame.color && v.b < d.frame.color) << c.id();
        }
      }
    }
  }
}

/// A true crossing, not a touch.
bool edges_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto opposite = [](std::int64_t u, std::int64_t v) { return (u > 0 && v < 0) || (u < 0 && v > 0); };
  return opposite(turn(a, b, c), turn(a, b, d)) && opposite(turn(c, d, a), turn(c, d, b));
}

TEST(Corpus, HasNoPolygonThatCrossesItself) {
  for (const Case& c : make_corpus({})) {
    for (const Drawing& d : c.drawings) {
      for (const TestPolygon& p : d.polygons) {
        if (p.size() > 200) continue;
        for (std::size_t i = 0; i < p.size(); ++i) {
          for (std::size_t k = i + 2; k < p.size(); ++k) {
            const auto at = [&](std::size_t n) { return Point{p[n % p.size()].x, p[n % p.size()].y}; };
            ASSERT_FALSE(edges_cross(at(i), at(i + 1), at(k), at(k + 1))) << c.id() << "\n" << flat_text(d);
          }
        }
      }
    }
  }
}

TEST(Corpus, LeavesNoSampleOpenButWhereItSaysSo) {
  for (const Case& c : make_corpus({})) {
    if (!c.expect_nothing_ambiguous || c.tile || c.kind == CaseKind::tiling) continue;
    for (const Drawing& d : c.drawings) {
      if (d.frame.x * d.frame.y > 300 * 300) continue;
      const Expectation expected(d, ConsistentRule::lb);
      for (int y = 0; y < d.frame.y; ++y) {
        for (int x = 0; x < d.frame.x; ++x) {
          if (expected.covering(x, y).size() > 1) {
            ASSERT_EQ(expected.admissible(x, y).size(), 1u) << c.id() << " " << x << " " << y;
          }
        }
      }
    }
  }
}

TEST(Corpus, TilesTheirAreaExactly) {
  for (const Case& c : make_corpus({})) {
    // Rounding turns some faces of the torus over: their overlap is expected, too.
    if (c.kind != CaseKind::tiling || c.name == "t-off" || c.id() == "tile/solid#2@1") continue;
    const Drawing& d = c.drawings.front();
    std::vector<int> count(window_of(d.frame).samples());
    for (const TestPolygon& p : d.polygons) {
      const Bitmap masks = coverage_masks(p, window_of(d.frame));
      for (std::size_t i = 0; i < count.size(); ++i) count[i] += masks.at[i] & 1;
    }
    EXPECT_LE(*std::ranges::max_element(count), 1) << c.id() << " overlaps";
  }
}

TEST(Corpus, PutsTilesIntoFourByFourLattices) {
  for (const Case& c : make_corpus({Level::quick, 1, false})) {
    if (!c.tile) continue;
    for (const ScreenVertex& v : c.drawings.front().polygons.front())
      EXPECT_TRUE(v.x >= 0 && v.x <= 3 && v.y >= 0 && v.y <= 3);
  }
}

TEST(IdentificationColors, DifferByFourInSomeChannel) {
  std::set<std::pair<int, int>> seen;
  for (std::size_t i = 0; i < 1024; ++i) {
    const Color c = identification_color(i);
    EXPECT_TRUE(seen.insert({c[0], c[1]}).second);
    EXPECT_GE(std::abs(c[0] - k_background[0]), 4);
    EXPECT_GE(c[0], 4);
  }
  std::set<Color> all;
  for (std::size_t i = 0; i < 16384; ++i) EXPECT_TRUE(all.insert(identification_color(i)).second) << i;
}

}  // namespace
}  // namespace farop::conformance
