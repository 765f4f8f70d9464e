// SPDX-License-Identifier: GPL-3.0-or-later
// The plug-ins of tests/hostile that one picture does not give away: `farop check` has to name them. And the
// program itself: others beside it, and its violent end, change nothing.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "support/shell.h"
#include "unit/isolate/hostile_rows.h"

namespace farop::test {
namespace {

/// What shows each of them, in a second.
const std::map<std::string, std::string> k_arguments = {{"21-uninitialised-depth", "--family det"},
                                                        {"22a-rand-in-fill-rule", "--family det"},
                                                        {"22b-time-dependent-colours", "--family det"},
                                                        {"23-state-between-frames", "--quick"},
                                                        {"24b-race", "--family det --threads 8"},
                                                        {"54-recognises-scenes", "--case smoke/letter-F#0"},
                                                        {"55-evades", "--quick"}};

std::vector<Row> rows_for_a_check() {
  std::vector<Row> rows = built_rows();
  std::erase_if(rows, [](const Row& row) { return !row.needs_check(); });
  return rows;
}

Row row_named(const std::string& name) {
  for (const Row& row : built_rows()) {
    if (row.name == name) return row;
  }
  ADD_FAILURE() << "there is no row " << name;
  return {};
}

std::string rasterizer_of(const Row& row) {
  return "'" + row.path + "' --plugin-option suite=" + suite();
}

Outcome check(const Row& row, const std::string& arguments) {
  const TemporaryFolder folder;
  return shell(folder, "farop check -q " + rasterizer_of(row) + " " + arguments);
}

/// Verdicts of the findings that are errors.
std::set<std::string> errors_in(const std::string& report) {
  std::set<std::string> verdicts;
  std::istringstream lines(report);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("E ")) verdicts.insert(line.substr(2, line.find(' ', 2) - 2));
  }
  return verdicts;
}

class HostileCheck : public testing::TestWithParam<Row> {};

TEST_P(HostileCheck, NamesItAndIsNotHarmed) {
  const Row& row = GetParam();
  const Surroundings surroundings;
  const auto arguments = k_arguments.find(row.name);
  ASSERT_NE(arguments, k_arguments.end());
  const Outcome run = check(row, arguments->second);
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  const std::set<std::string> errors = errors_in(run.out);
  EXPECT_TRUE(errors.contains(row.expected)) << run.out << run.err;
  std::cout << "[ verdict  ] " << row.name << ":";
  for (const std::string& verdict : errors) std::cout << ' ' << verdict;
  std::cout << '\n';
  surroundings.expect_unchanged(row.name);
}

INSTANTIATE_TEST_SUITE_P(All, HostileCheck, testing::ValuesIn(rows_for_a_check()),
                         [](const testing::TestParamInfo<Row>& row) { return test_name(row.param); });

TEST(HostileCheck, FindsNothingInInnocents) {
  const Row row = row_named("60-innocent");
  const Surroundings surroundings;
  const Outcome run = check(row, "--family smoke --family abi --family det --threads 8");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  surroundings.expect_unchanged(row.name);
}

TEST(HostileCheck, NotesThatAnswersDependOnTheSeed) {
  const Row row = row_named("54-recognises-scenes");
  const std::string known = "--case smoke/quad#0 --case cov/tri-random#0";
  const Outcome usual = check(row, known);
  EXPECT_EQ(usual.status, 0) << usual.out << usual.err;
  const Outcome other = check(row, known + " --seed 2");
  EXPECT_EQ(other.status, 1) << other.out << other.err;
  EXPECT_NE(other.out.find("note: the same cases pass under --seed 1"), std::string::npos) << other.out;
  // Not for one that fails under every seed.
  const Outcome both = check(row_named("55-evades"), known + " --seed 2");
  EXPECT_EQ(both.status, 1);
  EXPECT_EQ(both.out.find("--seed 1:"), std::string::npos) << both.out;
}

/// What a plug-in said that it sees, each kind of line once.
std::set<std::string> notes_in(const Outcome& run) {
  std::set<std::string> notes;
  std::istringstream lines(run.out + run.err);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(line.find("hostile-leak: "), std::string::npos) << line;
    if (const std::size_t at = line.find("hostile-note: "); at != std::string::npos)
      notes.insert(line.substr(at));
  }
  return notes;
}

TEST(HostileCheck, LooksFromInsideLikeEveryOtherCommand) {
  const std::string rasterizer = rasterizer_of(row_named("55-evades")) + " -v";
  const TemporaryFolder folder;
  shell(folder, "farop spd gears --size 1 -o gears.nff");
  const std::set<std::string> checked = notes_in(shell(folder, "farop check --quick " + rasterizer));
  EXPECT_EQ(checked.size(), 1u);
  EXPECT_EQ(checked, notes_in(shell(folder, "CI=true GRADESCOPE=1 farop check --quick " + rasterizer)));
  EXPECT_EQ(checked,
            notes_in(shell(folder, "farop render gears.nff -o gears.ppm --rasterizer " + rasterizer)));
  const std::string bench = "farop bench gears.nff --runs 1 -v --rasterizer ";
  EXPECT_EQ(checked, notes_in(shell(folder, bench + row_named("55-evades").path)));
}

TEST(HostileCheck, DoesNotDisturbAnInnocentBesideIt) {
  const TemporaryFolder folder;
  const std::string render = "farop render gears.nff -q --resolution 64x64 --rasterizer ";
  const std::string innocent =
      render + rasterizer_of(row_named("51j-newer-minor")) + " -o innocent.ppm && sha256sum < innocent.ppm";
  shell(folder, "farop spd gears --size 1 -o gears.nff");
  const Outcome alone = shell(folder, innocent);
  ASSERT_EQ(alone.status, 0) << alone.err;
  // Exit statuses of render: a refused call does not spoil the picture.
  const std::map<std::string, int> neighbours = {{"06-infinite-loop", 3},
                                                 {"12a-malloc-until-failure", 3},
                                                 {"27-fork-bomb", 0},
                                                 {"34a-floods-stdout", 0},
                                                 {"57-spins-cores", 0}};
  for (const auto& [name, status] : neighbours) {
    const Row row = row_named(name);
    const Surroundings surroundings;
    const TemporaryFolder other;
    Outcome hostile;
    std::thread neighbour([&] {
      hostile = shell(
          other,
          "farop render '" + (folder / "gears.nff").string() +
              "' -q --resolution 64x64 -o x.ppm --cpu 1 --wall 100 --memory 256 --threads 8 --rasterizer " +
              rasterizer_of(row));
    });
    for (int i = 0; i < 3; ++i) {
      const Outcome beside = shell(folder, innocent);
      EXPECT_EQ(beside.status, 0) << name << beside.err;
      EXPECT_EQ(beside.out, alone.out) << name;
    }
    neighbour.join();
    EXPECT_EQ(hostile.status, status) << name << hostile.err;
    surroundings.expect_unchanged(name);
  }
}

TEST(HostileCheck, LeavesNothingWhenItIsKilled) {
  const TemporaryFolder folder;
  shell(folder, "farop spd gears --size 1 -o gears.nff");
  const std::string command =
      "exec farop render gears.nff -q -o x.ppm --rasterizer " + rasterizer_of(row_named("06-infinite-loop"));
  std::mt19937 random(1);
  std::size_t orphans = 0;
  for (int i = 0; i < 20; ++i) {
    const Surroundings surroundings;
    // By its own process id, which the shell prints before it becomes the program.
    std::thread program([&] { shell(folder, "echo $$ > p; mv p pid; " + command); });
    pid_t pid = 0;
    for (int tries = 0; pid == 0 && tries < 10000; ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      pid = std::atoi(read_file(folder / "pid").c_str());
    }
    ASSERT_GT(pid, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 120));
    ::kill(pid, SIGKILL);
    const auto killed = std::chrono::steady_clock::now();
    program.join();
    // Its warden and what the warden had started come to this process as orphans.
    for (pid_t orphan = 0; (orphan = ::waitpid(-1, nullptr, 0)) > 0;) ++orphans;
    EXPECT_LT(std::chrono::steady_clock::now() - killed, std::chrono::seconds(2)) << i;
    surroundings.expect_unchanged("killed farop");
    std::filesystem::remove(folder / "pid");
  }
  EXPECT_GT(orphans, 0u);
}

}  // namespace
}  // namespace farop::test
