// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes that farop check draws: the same numbers from every compiler, in every build.
#include "check_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace farop::app {
namespace {

using namespace conformance;

// Optimised or not, by gcc or clang: whoever changes a scene, or how it is computed, on purpose changes this.
TEST(CheckScenes, AreTheSameOnEveryMachine) {
  std::vector<Case> cases;
  for (const SceneSource& source : check_scenes(Level::normal)) {
    Case& c = cases.emplace_back();
    c.family = "scene", c.name = source.name, c.index = source.index, c.drawings = {source.draw()};
    EXPECT_GT(c.drawings.front().polygons.size(), 10u) << c.id();
  }
  EXPECT_EQ(corpus_hash(cases), 11668030952614139168u);
}

TEST(CheckScenes, GrowWithTheLevel) {
  EXPECT_TRUE(check_scenes(Level::quick).empty());
  std::set<std::string> normal, thorough;
  for (const SceneSource& s : check_scenes(Level::normal)) normal.insert(s.name + std::to_string(s.index));
  for (const SceneSource& s : check_scenes(Level::thorough))
    thorough.insert(s.name + std::to_string(s.index));
  EXPECT_GT(thorough.size(), 2 * normal.size());
  EXPECT_TRUE(std::ranges::includes(thorough, normal)) << "a case keeps its name at every level";
}

}  // namespace
}  // namespace farop::app
