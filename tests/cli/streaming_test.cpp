// SPDX-License-Identifier: GPL-3.0-or-later
// farop export of scenes that go by in parts.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/shell.h"

namespace farop::test {
namespace {

using Json = nlohmann::json;

TEST(ExportStreaming, MemoryIsThatOfAPartHoweverLargeTheScene) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "memory is the sanitizer's";
#else
  const TemporaryFolder folder;
  const auto peak = [&](const std::string& command) {
    const Outcome run = shell(folder, command + " -q --stats s.json");
    EXPECT_EQ(run.status, 0) << run.err;
    return Json::parse(read_file(folder / "s.json")).at("memory").at("peak_bytes").get<double>() / 1e6;
  };
  ASSERT_EQ(
      shell(folder, "farop spd tetra --size 8 > small.nff; farop spd tetra --size 10 > large.nff").status, 0);
  const double small = peak("farop export small.nff -o small.scr --stream on");
  const double large =
      peak("farop export large.nff -o large.scr");  // 90 MB: streamed without being asked for
  const double kept = peak("farop export large.nff -o kept.scr --stream off");
  EXPECT_LT(large, 40);
  EXPECT_LT(large - small, 20);  // of sixteen times as many polygons; a small scene is less than a part
  EXPECT_GT(kept, large + 15);
  EXPECT_EQ(shell(folder, "cmp large.scr kept.scr").status, 0);
#endif
}

TEST(ExportStreaming, SaysSoAndCountsTheSame) {
  const TemporaryFolder folder;
  ASSERT_EQ(shell(folder, "farop spd gears --size 2 > g.nff").status, 0);
  const Outcome streamed = shell(folder, "farop export g.nff -o a.scr --stream on --stats a.json");
  const Outcome kept = shell(folder, "farop export g.nff -o b.scr --stats b.json");
  ASSERT_EQ(streamed.status, 0) << streamed.err;
  EXPECT_NE(streamed.err.find("streamed: the input was read 2 times"), std::string::npos) << streamed.err;
  EXPECT_EQ(kept.err.find("streamed"), std::string::npos) << kept.err;
  EXPECT_EQ(read_file(folder / "a.scr"), read_file(folder / "b.scr"));
  Json a = Json::parse(read_file(folder / "a.json")), b = Json::parse(read_file(folder / "b.json"));
  EXPECT_EQ(a.at("scene").at("readings"), 2);
  EXPECT_FALSE(b.at("scene").contains("readings"));
  for (const char* same : {"inputs", "view", "polygons", "warnings"})
    EXPECT_EQ(a.at(same), b.at(same)) << same;
  for (const char* same : {"objects", "surfaces", "vertices", "lights", "bounds", "background"})
    EXPECT_EQ(a.at("scene").at(same), b.at("scene").at(same)) << same;
}

TEST(ExportStreaming, KeepsScenesThatCanBeReadOnlyOnce) {
  const TemporaryFolder folder;
  const Outcome piped = shell(folder, "farop spd gears --size 1 | farop export - -o a.scr");
  EXPECT_EQ(piped.status, 0) << piped.err;
  EXPECT_EQ(piped.err.find("streamed"), std::string::npos);
  const Outcome refused = shell(folder, "farop spd gears --size 1 | farop export - -o b.scr --stream on");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("standard input can be read only once"), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "b.scr"));
}

TEST(ExportStreaming, ShowsErrorsAsEverAndLeavesNoFile) {
  const TemporaryFolder folder;
  ASSERT_EQ(shell(folder, "farop spd tetra --size 3 > t.nff; echo 'p 3 0 0' >> t.nff").status, 0);
  const Outcome streamed = shell(folder, "farop export t.nff -o t.scr --stream on");
  const Outcome kept = shell(folder, "farop export t.nff -o t.scr");
  EXPECT_EQ(streamed.status, 1);
  EXPECT_EQ(streamed.err, kept.err);
  EXPECT_FALSE(std::filesystem::exists(folder / "t.scr"));
}

}  // namespace
}  // namespace farop::test
