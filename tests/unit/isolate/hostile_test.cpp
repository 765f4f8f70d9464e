// SPDX-License-Identifier: GPL-3.0-or-later
// Every plug-in of tests/hostile in its cage: the verdict, the polygon, nothing left behind, and an innocent
// one draws the right picture afterwards.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "core/error.h"
#include "plugin/plugin_rasterizer.h"
#include "unit/isolate/hostile_rows.h"

namespace farop {
namespace {

using namespace test;
namespace fs = std::filesystem;

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

/// This machine offers A to D.
bool machine_has_all_walls() {
  static const bool all = missing_walls(probe_isolation(own_runner())).empty();
  return all;
}

/// First error by discovery, then what ended it, then the pictures.
Verdict judge(const std::string& path, const IsolationOptions& options, std::chrono::milliseconds pause) {
  Verdict verdict;
  verdict.walled = options.without.empty() && machine_has_all_walls();
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
    const RunnerReport report = rasterizer->report();
    verdict.output = report.out + "\n" + report.err;
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

/// With all walls only the first verdict will do.
bool accepts(const Row& row, const Verdict& got) {
  const std::string& verdict = got.verdict;
  if (verdict == row.expected) return true;
  if (got.walled) return false;
  if (std::count(row.also.begin(), row.also.end(), verdict) > 0) return true;
  // Emptied pages inside the frame: which pixels change depends on where they lie.
  return verdict == "cov.missing" && row.expected.starts_with("frame.");
}

void expect_innocent_is_unharmed() {
  IsolatedRasterizer innocent(std::string(FAROP_HOSTILE) + "/pass/51j-newer-minor.so", options_for_tests(),
                              k_drawing);
  draw(innocent, scene(1));
  EXPECT_TRUE(innocent.take().rgb == right_pictures()[0]);
  EXPECT_TRUE(innocent.findings().empty());
}

IsolationOptions options_for(const Row& row) {
  IsolationOptions options = options_for_tests();
  options.plugin_options["suite"] = suite();
  options.guard_every_polygon = row.number() == 20;
  options.limits.cpu_seconds = 2;
  options.limits.wall_seconds = 30;
  const bool sleeps = row.expected == "limit.time" || row.name.find("sleep") != std::string::npos;
  if (sleeps || row.name.find("loop") != std::string::npos)
    options.limits.cpu_seconds = 0.25, options.limits.wall_seconds = 0.75;
  // A gigabyte from one process to another takes long where many others want to run.
  if (row.number() == 34) options.limits.cpu_seconds = 20, options.limits.wall_seconds = 300;
  if (row.number() == 60 || row.number() == 29) options.limits.threads = 8;
  if (row.number() == 24 || row.number() == 49 || row.number() == 57) options.limits.threads = 8;
  return options;
}

void expect_verdict(const Row& row, const IsolationOptions& options) {
  const Surroundings surroundings;
  Verdict verdict;
  try {
    // 24a goes on writing after end_frame(): there has to be an after.
    verdict = judge(row.path, options, std::chrono::milliseconds(row.number() == 24 ? 50 : 0));
  } catch (const Error& error) {
    ADD_FAILURE() << row.name << ": not blamed on the plug-in: " << error.what();
  }
  std::cout << "[ verdict  ] " << row.name << ": " << verdict.verdict << (verdict.message.empty() ? "" : ": ")
            << verdict.message << '\n';
  EXPECT_TRUE(accepts(row, verdict)) << row.name << ": " << verdict.verdict << " instead of " << row.expected
                                     << ": " << verdict.message;
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
  // These look for what they should not see: a right picture passes, but what they tried has to have failed.
  if (number == 31 && verdict.walled) {
    EXPECT_NE(verdict.output.find("hostile-refused: "), std::string::npos) << row.name << verdict.output;
  }
  if (verdict.walled) {
    EXPECT_EQ(verdict.output.find("hostile-hole: "), std::string::npos) << row.name << ": " << verdict.output;
    EXPECT_EQ(verdict.output.find("hostile-leak: "), std::string::npos) << row.name << ": " << verdict.output;
  }
  surroundings.expect_unchanged(row.name);
  expect_innocent_is_unharmed();
}

class Hostile : public testing::TestWithParam<Row> {};

TEST_P(Hostile, GetsItsVerdictAndHarmsNobody) {
  const Row& row = GetParam();
  right_pictures();
  expect_verdict(row, options_for(row));
}

/// The least that any machine offers.
TEST_P(Hostile, GetsItsVerdictWithoutNamespacesAndLandlock) {
  const Row& row = GetParam();
  right_pictures();
  IsolationOptions options = options_for(row);
  options.without = "BC";
  expect_verdict(row, options);
}

/// `farop check` has the others: hostile_check_test.cpp.
std::vector<Row> rows_for_one_run() {
  std::vector<Row> rows = built_rows();
  std::erase_if(rows, [](const Row& row) { return row.needs_check(); });
  return rows;
}

INSTANTIATE_TEST_SUITE_P(All, Hostile, testing::ValuesIn(rows_for_one_run()),
                         [](const testing::TestParamInfo<Row>& row) { return test_name(row.param); });

TEST(Hostile, ThereAreEnoughOfThem) {
  EXPECT_GT(built_rows().size(), 100u);
}

TEST(Hostile, FilesThatAreNoLibrariesAreRefusedInWords) {
  const fs::path folder = fs::path(FAROP_TEST_PLUGINS) / ("bad-files-" + suite());
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
