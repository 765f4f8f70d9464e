// SPDX-License-Identifier: GPL-3.0-or-later
// `farop check` as its user meets it.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "support/sanitizers.h"
#include "support/shell.h"

namespace {

using namespace farop::test;

TEST(CheckCommand, PassesTheShippedRasterizers) {
  const TemporaryFolder folder;
  for (const char* name : {"internal", "trapezoid", "scanline_fill", "watkins", "solids"}) {
    const Outcome run =
        shell(folder, std::string("farop check -q ") + (k_address_sanitizer ? "--quick " : "") + name);
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    // A remark on how times grow may stand before it where the machine is busy.
    EXPECT_NE(("\n" + run.out).find("\npass: "), std::string::npos) << run.out;
  }
}

TEST(CheckCommand, PassesARightRasterizerThoroughlyWithAnotherSeed) {
  const TemporaryFolder folder;
  const Outcome run =
      shell(folder,
            "farop check -q trapezoid --thorough --seed 7 --family smoke --family cov --family tile "
            "--family depth --family colour --family meta --family abi --family det "
            "--family scene/gears --family scene/shapes");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_NE(run.out.find("scene        8 passed"), std::string::npos) << run.out;
}

TEST(CheckCommand, ChecksProgramsAndLibrariesInThisProcess) {
  const TemporaryFolder folder;
  EXPECT_EQ(shell(folder, "farop check -q --cmd 'farop raster -q {flat} -o {ppm}' --family smoke").status, 0);
  EXPECT_EQ(shell(folder, "farop check -q trapezoid --in-process --quick").status, 0);
}

TEST(CheckCommand, NamesWhatIsWrongAndWritesTheExampleThatRepeatsIt) {
  const TemporaryFolder folder;
  // Upside down: the picture's rows are written in the wrong order.
  const std::string upside_down =
      "--cmd 'farop raster -q {flat} -o p.png && farop raster -q {flat} --y-down -o {ppm}'";
  const Outcome run = shell(folder, "farop check -q " + upside_down + " --family smoke --examples found");
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  EXPECT_TRUE(run.out.starts_with("E ")) << run.out;
  EXPECT_NE(run.out.find("fail: "), std::string::npos);
  EXPECT_NE(run.out.find("farop check --case found"), std::string::npos) << run.out;
}

TEST(CheckCommand, ListsItsCasesWithReasons) {
  const TemporaryFolder folder;
  const Outcome run = shell(folder, "farop check --list --family smoke");
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.out.find("smoke/lecture#0@1"), std::string::npos) << run.out;
}

TEST(CheckCommand, ListsScenesWithTheSameNamesAtEveryLevel) {
  const TemporaryFolder folder;
  const std::string some = shell(folder, "farop check --list --family scene").out;
  const std::string all = shell(folder, "farop check --list --thorough --family scene").out;
  EXPECT_NE(some.find("scene/teapot#1@1"), std::string::npos) << some;
  EXPECT_EQ(some.find("scene/teapot#2@1"), std::string::npos) << some;
  EXPECT_NE(all.find("scene/teapot#5@1"), std::string::npos) << all;
  EXPECT_NE(all.find("scene/walk#0@1"), std::string::npos) << all;
  for (std::size_t at = 0; at < some.size();) {
    const std::size_t end = some.find('\n', at);
    EXPECT_NE(all.find(some.substr(at, end - at)), std::string::npos) << some.substr(at, end - at);
    at = end + 1;
  }
}

TEST(CheckCommand, LeavesLessThanHalfAPercentOfATriangulatedSceneOpen) {
  const TemporaryFolder folder;
  const Outcome run = shell(folder, "farop check -q internal --family scene --json result.json");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  std::ifstream file(folder.path() / "result.json");
  const auto json = nlohmann::json::parse(file);
  int seen = 0;
  for (const auto& c : json["cases"]) {
    if (c["id"].get<std::string>().find("#1@") == std::string::npos) continue;
    ++seen;
    EXPECT_LT(c["ambiguous"].get<double>(), 0.005 * c["judged"].get<double>()) << c["id"];
  }
  EXPECT_EQ(seen, 16);
}

TEST(CheckCommand, RefusesWhatItDoesNotKnow) {
  const TemporaryFolder folder;
  EXPECT_EQ(shell(folder, "farop check").status, 2);
  EXPECT_EQ(shell(folder, "farop check internal --family nonsense").status, 2);
  EXPECT_EQ(shell(folder, "farop check internal --case nonsense").status, 2);
  EXPECT_EQ(shell(folder, "farop check internal --quick --thorough").status, 2);
  EXPECT_EQ(shell(folder, "farop check null").status, 2);
  EXPECT_EQ(shell(folder, "echo nonsense > bad.scr; farop check internal --case bad.scr").status, 1);
}

TEST(CheckCommand, RunsAFlatFileAsACase) {
  const TemporaryFolder folder;
  const Outcome run =
      shell(folder,
            "farop spd teapot --size 2 -o pot.nff -q; farop export pot.nff -o pot.scr -q --resolution "
            "128x128 --triangles; farop check internal --case pot.scr -q");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_NE(run.out.find("pass: 1 cases"), std::string::npos) << run.out;
}

TEST(CheckCommand, TakesTheRasterizerBeforeAndAfterItsCase) {
  const TemporaryFolder folder;
  EXPECT_EQ(shell(folder, "farop check -q --case smoke/quad#0 trapezoid").status, 0);
  EXPECT_EQ(shell(folder, "farop check -q trapezoid --case smoke/quad#0 --family smoke").status, 0);
}

TEST(CheckCommand, RunsAFolderOfEarlierCasesAfterSmoke) {
  const TemporaryFolder folder;
  EXPECT_EQ(shell(folder,
                  "mkdir old; printf '8 8 512 256\\n1\\n1\\n3 5 1\\n1 1 9 9 9 9\\n6 1 9 9 9 9\\n1 5 9 9 9 "
                  "9\\n1\\n127\\n' "
                  "> old/corner.scr")
                .status,
            0);
  const Outcome run = shell(folder, "farop check -q trapezoid --regress old --family smoke --family regress");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_NE(run.out.find("regress      1 passed"), std::string::npos) << run.out;
  EXPECT_EQ(shell(folder, "farop check -q trapezoid --regress nowhere").status, 1);
}

TEST(CheckCommand, ReportsWhatItHasWhenItIsStopped) {
  const TemporaryFolder folder;
  const Outcome run = shell(folder,
                            "farop check -q trapezoid --thorough --jsonl lines --json r.json & p=$!; "
                            "while ! [ -s lines ]; do sleep 0.1; done; kill -TERM $p; wait $p");
  EXPECT_EQ(run.status, 4) << run.out << run.err;
  EXPECT_NE(run.err.find("stopped by a signal"), std::string::npos) << run.err;
  EXPECT_EQ(shell(folder, "grep -q '\"interrupted\"' r.json && grep -q 'not reached' r.json").status, 0);
}

TEST(CheckCommand, JudgesPicturesThatWereMadeElsewhere) {
  const TemporaryFolder folder;
  const std::string family = " --family smoke --family colour -q";
  EXPECT_EQ(shell(folder, "farop check --emit away" + family).status, 0);
  EXPECT_EQ(shell(folder, "farop check --images away" + family).status, 1) << "nothing is drawn yet";
  EXPECT_EQ(shell(folder, "cd away && for f in *.scr; do farop raster -q $f -o ${f%.scr}.ppm; done").status,
            0);
  const Outcome run = shell(folder, "farop check --images away" + family);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_EQ(shell(folder,
                  "for f in away/*.scr; do cp $(ls -S away/*.ppm | tail -1) ${f%.scr}.ppm; done; farop check "
                  "--images away" +
                      family)
                .status,
            1);
}

}  // namespace
