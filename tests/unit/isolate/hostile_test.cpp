// SPDX-License-Identifier: GPL-3.0-or-later
// Every plug-in of tests/hostile in its cage: the verdict, the polygon, nothing left behind, and an innocent
// one draws the right picture afterwards.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "core/error.h"
#include "plugin/plugin_rasterizer.h"
#include "unit/isolate/bench.h"

namespace farop {
namespace {

using namespace test;
namespace fs = std::filesystem;

struct Row {
  std::string name, expected, path;
  std::vector<std::string> also;

  int number() const { return std::atoi(name.c_str()); }
};

std::ostream& operator<<(std::ostream& out, const Row& row) {
  return out << row.name;
}

std::vector<Row> rows_of(const std::string& manifest) {
  std::vector<Row> rows;
  std::ifstream file(manifest);
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    Row row;
    std::string also;
    std::getline(fields, row.name, '\t');
    std::getline(fields, row.expected, '\t');
    std::getline(fields, also, '\t');
    std::getline(fields, row.path, '\t');
    std::istringstream words(also);
    for (std::string word; std::getline(words, word, ',');) row.also.push_back(word);
    rows.push_back(row);
  }
  return rows;
}

/// Rows that one run cannot judge: they need the comparisons of a check.
const std::map<std::string, std::string> k_needs_check = {
    {"21-uninitialised-depth", "shows when runs with differently filled heaps are compared"},
    {"22a-rand-in-fill-rule", "shows when two runs are compared"},
    {"22b-time-dependent-colours", "shows when two runs are compared"},
    {"23-state-between-frames", "shows when frames A, B, A are compared"},
    {"24b-race", "shows when runs with threads are compared"},
    {"54-recognises-scenes", "shows under another seed"},
    {"55-evades", "shows when check and render are compared"}};

/// Three polygons and more, a horizontal edge in polygon 2, and one in the way of all.
Drawing scene(std::uint64_t seed) {
  Drawing drawing = triangles(50, 40, 12, 5, 0, seed);
  ScreenPolygonBatch& first = drawing.batches.front();
  first.vertices[6].y = first.vertices[7].y = 3;
  first.vertices[6].x = 5, first.vertices[7].x = 40, first.vertices[8].x = 20, first.vertices[8].y = 30;
  return drawing;
}

std::vector<Drawing> frames_to_draw() {
  return {scene(1), scene(2), scene(1), scene(2), scene(1), scene(1)};
}

const PluginDrawing k_drawing{1, {0.2, 0.4, 0.6}};

/// The right pictures: the collection's own honest rasterizer, here.
const std::vector<std::vector<std::uint8_t>>& right_pictures() {
  static const std::vector<std::vector<std::uint8_t>> pictures = [] {
    static HostServices services({}, {});
    static const PluginLibrary library =
        open_plugin(std::string(FAROP_HOSTILE) + "/pass/51j-newer-minor.so", services);
    std::vector<std::vector<std::uint8_t>> all;
    PluginRasterizer rasterizer(library, services, k_drawing);
    for (const Drawing& frame : frames_to_draw()) {
      draw(rasterizer, frame);
      all.push_back(rasterizer.take().rgb);
    }
    return all;
  }();
  return pictures;
}

struct Verdict {
  std::string verdict = "pass", message;
  std::optional<std::uint32_t> polygon;
  std::string output;
  std::vector<std::string> warnings;
  bool walled = false;  ///< A to D all stood
};

void take_report(Verdict& verdict, const IsolatedRasterizer& rasterizer) {
  const RunnerReport report = rasterizer.report();
  verdict.output = report.out + "\n" + report.err;
  verdict.walled = true;
  for (const IsolationLayer& layer : report.layers) verdict.walled = verdict.walled && layer.holds;
}

/// First error by discovery, then what ended it, then the pictures.
Verdict judge(const std::string& path, const IsolationOptions& options, std::chrono::milliseconds pause) {
  Verdict verdict;
  const auto say = [&](const PluginFinding& finding) {
    if (finding.warning) {
      verdict.warnings.push_back(finding.verdict);
    } else if (verdict.verdict == "pass") {
      verdict.verdict = finding.verdict;
      verdict.message = finding.message;
      verdict.polygon = finding.polygon;
    }
  };
  std::unique_ptr<IsolatedRasterizer> rasterizer;
  std::string picture = "pass";
  std::optional<PluginFinding> end;
  try {
    rasterizer = std::make_unique<IsolatedRasterizer>(path, options, k_drawing);
    const std::vector<Drawing> frames = frames_to_draw();
    for (std::size_t i = 0; i < frames.size(); ++i) {
      draw(*rasterizer, frames[i]);
      std::this_thread::sleep_for(pause);
      const std::vector<std::uint8_t> got = rasterizer->take().rgb;
      if (got == right_pictures()[i] || picture != "pass") continue;
      bool blank = true;
      for (std::size_t at = 3; at < got.size(); at += 3)
        blank =
            blank && std::equal(got.begin(), got.begin() + 3, got.begin() + static_cast<std::ptrdiff_t>(at));
      picture = blank ? "frame.blank" : "cov.missing";
    }
  } catch (const PluginFailure& failure) {
    end = failure.finding();
  }
  if (rasterizer) {
    for (const PluginFinding& finding : rasterizer->findings()) say(finding);
    take_report(verdict, *rasterizer);
  }
  if (end) say(*end);
  if (verdict.verdict == "pass") verdict.verdict = picture;
  if (verdict.verdict == "pass" &&
      std::count(verdict.warnings.begin(), verdict.warnings.end(), "limit.output") > 0) {
    verdict.verdict = "limit.output";
  }
  rasterizer.reset();
  return verdict;
}

bool accepts(const Row& row, const std::string& verdict) {
  if (verdict == row.expected || std::count(row.also.begin(), row.also.end(), verdict) > 0) return true;
  // Emptied pages inside the frame: which pixels change depends on where they lie.
  return verdict == "cov.missing" && row.expected.starts_with("frame.");
}

std::set<int> marked_processes() {
  std::set<int> found;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "comm");
    std::string name;
    if (std::getline(file, name) && name == "farop-hostile")
      found.insert(std::atoi(entry.path().filename().c_str()));
  }
  return found;
}

/// Files that the writing plug-ins would find.
class Canaries {
 public:
  Canaries() {
    for (const char* folder : {"/tmp", "/var/tmp", "/dev/shm", "."}) {
      std::error_code error;
      if (!fs::is_directory(folder, error)) continue;
      std::ofstream(fs::path(folder) / "farop-canary") << "results of somebody else\n";
      folders_.emplace_back(folder);
    }
  }
  ~Canaries() {
    std::error_code error;
    for (const fs::path& folder : folders_) fs::remove(folder / "farop-canary", error);
  }
  void expect_untouched() const {
    for (const fs::path& folder : folders_) {
      std::ifstream file(folder / "farop-canary");
      std::string line;
      EXPECT_TRUE(std::getline(file, line) && line == "results of somebody else") << folder;
      for (const char* made : {"farop-canary-2", "farop-canary-fill"})
        EXPECT_FALSE(fs::exists(folder / made)) << folder << made;
    }
  }

 private:
  std::vector<fs::path> folders_;
};

void expect_innocent_is_unharmed() {
  IsolatedRasterizer innocent(std::string(FAROP_HOSTILE) + "/pass/51j-newer-minor.so", options_for_tests(),
                              k_drawing);
  draw(innocent, scene(1));
  EXPECT_TRUE(innocent.take().rgb == right_pictures()[0]);
  EXPECT_TRUE(innocent.findings().empty());
}

IsolationOptions options_for(const Row& row) {
  IsolationOptions options = options_for_tests();
  options.guard_every_polygon = row.number() == 20;
  options.limits.cpu_seconds = 2;
  options.limits.wall_seconds = 30;
  const bool sleeps = row.expected == "limit.time" || row.name.find("sleep") != std::string::npos;
  if (sleeps || row.name.find("loop") != std::string::npos)
    options.limits.cpu_seconds = 0.25, options.limits.wall_seconds = 0.75;
  if (row.number() == 60 || row.number() == 29) options.limits.threads = 8;
  if (row.number() == 24 || row.number() == 49 || row.number() == 57) options.limits.threads = 8;
  return options;
}

void expect_verdict(const Row& row, const IsolationOptions& options) {
  const Belongings before = belongings();
  const Canaries canaries;
  Verdict verdict;
  try {
    // 24a goes on writing after end_frame(): there has to be an after.
    verdict = judge(row.path, options, std::chrono::milliseconds(row.number() == 24 ? 50 : 0));
  } catch (const Error& error) {
    ADD_FAILURE() << row.name << ": not blamed on the plug-in: " << error.what();
  }
  std::cout << "[ verdict  ] " << row.name << ": " << verdict.verdict << (verdict.message.empty() ? "" : ": ")
            << verdict.message << '\n';
  EXPECT_TRUE(accepts(row, verdict.verdict))
      << row.name << ": " << verdict.verdict << " instead of " << row.expected << ": " << verdict.message;
  const int number = row.number();
  const bool names_polygon = number <= 5 || number == 15 || number == 18 || number == 20;
  if (names_polygon) {
    EXPECT_EQ(verdict.polygon, 2u) << row.name << ": " << verdict.message;
  }
  if (number == 14) {
    EXPECT_NE(verdict.message.find("row -1, column"), std::string::npos) << verdict.message;
  }
  if (number == 15) {
    EXPECT_NE(verdict.message.find("row 40, column 0"), std::string::npos) << verdict.message;
  }
  if (number == 59) {
    EXPECT_EQ(verdict.warnings, std::vector<std::string>{"memory.leak"});
  }
  if (verdict.walled) {
    EXPECT_EQ(verdict.output.find("hostile-hole: "), std::string::npos) << row.name << ": " << verdict.output;
    EXPECT_EQ(verdict.output.find("hostile-leak: "), std::string::npos) << row.name << ": " << verdict.output;
  }
  canaries.expect_untouched();
  EXPECT_TRUE(marked_processes().empty()) << row.name;
  EXPECT_TRUE(processes_running(own_runner()).empty()) << row.name;
  const Belongings after = belongings();
  EXPECT_EQ(before.descriptors, after.descriptors) << row.name;
  EXPECT_EQ(before.children, after.children) << row.name;
  EXPECT_EQ(before.memories, after.memories) << row.name;
  expect_innocent_is_unharmed();
}

class Hostile : public testing::TestWithParam<Row> {};

TEST_P(Hostile, GetsItsVerdictAndHarmsNobody) {
  const Row& row = GetParam();
  if (const auto why = k_needs_check.find(row.name); why != k_needs_check.end()) GTEST_SKIP() << why->second;
  right_pictures();
  expect_verdict(row, options_for(row));
}

/// The least that any machine offers.
TEST_P(Hostile, GetsItsVerdictWithoutNamespacesAndLandlock) {
  const Row& row = GetParam();
  if (const auto why = k_needs_check.find(row.name); why != k_needs_check.end()) GTEST_SKIP() << why->second;
  right_pictures();
  IsolationOptions options = options_for(row);
  options.without = "BC";
  expect_verdict(row, options);
}

INSTANTIATE_TEST_SUITE_P(All, Hostile,
                         testing::ValuesIn(rows_of(std::string(FAROP_HOSTILE) + "/manifest.txt")),
                         [](const testing::TestParamInfo<Row>& row) {
                           std::string name = row.param.name;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
                           return name;
                         });

TEST(Hostile, ThereAreEnoughOfThem) {
  EXPECT_GT(rows_of(std::string(FAROP_HOSTILE) + "/manifest.txt").size(), 100u);
}

TEST(Hostile, FilesThatAreNoLibrariesAreRefusedInWords) {
  const fs::path folder = fs::path(FAROP_TEST_PLUGINS) / "bad-files";
  fs::create_directories(folder);
  const std::string hostile = FAROP_HOSTILE;
  const std::string command = std::string("sh ") + FAROP_HOSTILE_SOURCES + "/make-bad-files.sh '" +
                              folder.string() + "' '" + hostile + "/pass/51j-newer-minor.so' '" + hostile +
                              "/helpers/hostile_helper_pie' '" + hostile + "/helpers/hostile_helper_no_pie'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  right_pictures();
  const std::vector<Row> rows = rows_of(folder / "manifest.txt");
  EXPECT_GE(rows.size(), 15u);
  for (const Row& row : rows) expect_verdict(row, options_for(row));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace farop
