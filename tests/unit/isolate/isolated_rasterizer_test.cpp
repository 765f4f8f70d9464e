// SPDX-License-Identifier: GPL-3.0-or-later
// An honest rasterizer draws in its own process what it draws in ours.
#include "isolate/isolated_rasterizer.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "core/hardware_counters.h"
#include "plugin/plugin_rasterizer.h"
#include "unit/isolate/bench.h"

namespace farop {
namespace {

using namespace test;

/// Draws the same frames here and there.
void expect_same(const std::vector<Drawing>& frames, const PluginDrawing& how,
                 bool guard_every_polygon = false) {
  HostServices services({}, {});
  const PluginLibrary library = open_plugin(plugin_path("filler"), services);
  ASSERT_EQ(library.failure, LoadFailure::none) << library.message;
  PluginRasterizer here(library, services, how);
  IsolationOptions options = options_for_tests();
  options.guard_every_polygon = guard_every_polygon;
  IsolatedRasterizer there(plugin_path("filler"), options, how);
  for (const Drawing& frame : frames) {
    draw(here, frame);
    draw(there, frame);
    const Framebuffer expected = here.take(), got = there.take();
    ASSERT_EQ(expected.width, got.width);
    ASSERT_EQ(expected.height, got.height);
    EXPECT_TRUE(expected.rgb == got.rgb) << frame.frame.resolution.x << " x " << frame.frame.resolution.y;
  }
  EXPECT_TRUE(there.findings().empty()) << there.findings().front().message;
}

TEST(IsolatedRasterizer, DrawsWhatTheRasterizerDrawsInThisProcess) {
  const PluginDrawing plain{1, {0.25, 0.5, 1}};
  expect_same({triangles(1, 1, 3, 1), triangles(17, 31, 40, 7), triangles(17, 31, 41, 7, 0, 8),
               triangles(640, 480, 60, 50), triangles(640, 480, 61, 50, 0, 9),
               triangles(640, 480, 62, 50, 0, 10), triangles(31, 17, 5, 5), triangles(32, 32, 0, 1)},
              plain);
}

TEST(IsolatedRasterizer, DrawsLargeFramesBetweenSmallOnes) {
  // More than is kept (32 MiB), more than two take turns with (64 MiB).
  const Drawing large = triangles(4000, 3000, 2, 1), larger = triangles(6000, 4000, 2, 1);
  expect_same({triangles(20, 10, 9, 5), large, larger, triangles(20, 10, 9, 5, 0, 3), larger, large},
              {1, {0.1, 0.5, 0.9}});
}

TEST(IsolatedRasterizer, AveragesSamplesAndFlipsLikeTheOneInThisProcess) {
  Drawing down = triangles(30, 12, 40, 7, 4);
  down.frame.y_down = true;
  expect_same({triangles(30, 12, 40, 7, 4), down, triangles(30, 12, 40, 7, 0)}, {3, {1, 0, 0}});
}

TEST(IsolatedRasterizer, KeepsTheOrderOfPolygonsAcrossChunksAndBatchesOfAnySize) {
  // 100 bytes a polygon and more: several chunks, more of them than the ring has places.
  expect_same({triangles(5, 4, 40000, 100), triangles(5, 4, 40000, 39999, 0, 9)}, {});
  // One batch that fits into no place of the ring.
  expect_same({triangles(5, 4, 40000, 40000)}, {});
}

TEST(IsolatedRasterizer, DrawsTheSameWithEveryPolygonOnItsOwn) {
  expect_same({triangles(40, 30, 100, 7, 4), triangles(40, 30, 100, 100)}, {2, {0, 0, 1}}, true);
}

TEST(IsolatedRasterizer, HandsOnWhatTheRasterizerSaysOfItself) {
  IsolationOptions options = options_for_tests();
  std::vector<std::string> lines;
  options.log = [&](farop_log_level level, const std::string& line) {
    lines.push_back(std::to_string(level) + " " + line);
  };
  const IsolatedRasterizer rasterizer(plugin_path("filler"), options, {});
  EXPECT_EQ(rasterizer.description().name, "filler");
  EXPECT_EQ(rasterizer.description().summary, "an honest triangle filler");
  EXPECT_EQ(rasterizer.description().abi_version, FAROP_ABI_VERSION);
  EXPECT_TRUE(rasterizer.draws_here());
  EXPECT_TRUE(rasterizer.wants().vertex_ids);
  EXPECT_FALSE(rasterizer.wants().normals);
  EXPECT_EQ(lines, std::vector<std::string>{"1 filler: ready"});
}

TEST(IsolatedRasterizer, ReportsTimesOfBothSides) {
  IsolatedRasterizer rasterizer(plugin_path("filler"), options_for_tests(), {});
  draw(rasterizer, triangles(200, 200, 300, 50));
  const RunnerReport report = rasterizer.report();
  EXPECT_GT(report.runner.polygon.elapsed, 0);
  EXPECT_GT(report.runner.begin_frame.elapsed, 0);
  EXPECT_GT(report.judge, report.runner.polygon.elapsed);
  // Counters are opened before the walls stand, or not at all.
  EXPECT_EQ(report.runner.polygon.cycles.has_value(), HardwareCounters::of_process().cycles.error() == 0);
  EXPECT_GT(report.cpu, 0);
  ASSERT_EQ(report.layers.size(), 6u);
  EXPECT_EQ(report.layers[0].id, "0 process");
  EXPECT_TRUE(report.layers[0].holds);
}

TEST(IsolatedRasterizer, LeavesNothingBehind) {
  const Belongings before = belongings();
  for (const char* sin : {"", "segv", "loop", "leave-child", "hang-in-destroy"}) {
    IsolationOptions options = options_for_tests();
    options.limits.cpu_seconds = 0.2;
    sin_finding(sin, options);
    const Belongings after = belongings();
    EXPECT_EQ(before.descriptors, after.descriptors) << sin;
    EXPECT_EQ(before.children, after.children) << sin;
    EXPECT_EQ(before.memories, after.memories) << sin;
    EXPECT_TRUE(processes_running(own_runner()).empty()) << sin;
  }
}

TEST(IsolatedRasterizer, LeavesNothingBehindWithoutWalls) {
  IsolationOptions options = options_for_tests();
  options.isolation = Isolation::off;
  // A grandchild in a session of its own, that nobody waits for.
  EXPECT_EQ(sin_finding("leave-child", options).verdict, "pass");
  EXPECT_TRUE(processes_running(own_runner()).empty());
}

TEST(IsolatedRasterizer, GoesOnAfterFailures) {
  IsolationOptions options = options_for_tests();
  for (const char* sin : {"status", "segv"}) {
    options.plugin_options["sin"] = sin;
    options.plugin_options["frame"] = "1";
    IsolatedRasterizer rasterizer(plugin_path("sinner"), options, {});
    const Drawing drawing = triangles(16, 16, 5, 2);
    draw(rasterizer, drawing);
    const std::vector<std::uint8_t> right = rasterizer.take().rgb;
    EXPECT_THROW(draw(rasterizer, drawing), PluginFailure) << sin;
    draw(rasterizer, drawing);
    EXPECT_EQ(rasterizer.take().rgb, right) << sin;
  }
}

void judge_that_is_killed(int ready) {
  IsolationOptions options = options_for_tests();
  options.plugin_options["sin"] = "loop";
  const char byte = 'r';
  if (::write(ready, &byte, 1) != 1) ::_exit(1);
  IsolatedRasterizer rasterizer(plugin_path("sinner"), options, {});
  draw(rasterizer, triangles(16, 16, 5, 2));
  ::_exit(0);
}

TEST(IsolatedRasterizer, NeitherRunnerNorWardenOutlivesAJudgeThatIsKilledAtAnyMoment) {
  std::size_t seen = 0;
  for (int milliseconds = 0; milliseconds < 40; milliseconds += 2) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t judge = ::fork();
    if (judge == 0) judge_that_is_killed(ready[1]);
    char byte = 0;
    ::close(ready[1]);
    ASSERT_EQ(::read(ready[0], &byte, 1), 1);
    ::close(ready[0]);
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    seen += processes_running(own_runner()).size();
    ::kill(judge, SIGKILL);
    ::waitpid(judge, nullptr, 0);
    // A while: it may have been about to start.
    int calm = 0;
    for (int i = 0; i < 200 && calm < 3; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      calm = processes_running(own_runner()).empty() ? calm + 1 : 0;
    }
    EXPECT_EQ(calm, 3) << milliseconds;
  }
  EXPECT_GT(seen, 0u);
}

TEST(IsolatedRasterizer, OneThatMisbehavesDoesNotDisturbItsNeighbour) {
  const Drawing drawing = triangles(64, 48, 200, 20);
  IsolatedRasterizer alone(plugin_path("filler"), options_for_tests(), {});
  draw(alone, drawing);
  const std::vector<std::uint8_t> right = alone.take().rgb;
  for (const char* sin : {"loop", "memory", "fork", "print", "segv"}) {
    IsolationOptions options = options_for_tests();
    options.limits.cpu_seconds = 0.3;
    std::thread neighbour([&] { sin_finding(sin, options); });
    for (int i = 0; i < 20; ++i) {
      IsolatedRasterizer rasterizer(plugin_path("filler"), options_for_tests(), {});
      draw(rasterizer, drawing);
      EXPECT_TRUE(rasterizer.take().rgb == right) << sin;
      EXPECT_TRUE(rasterizer.findings().empty()) << sin;
    }
    neighbour.join();
  }
}

TEST(IsolatedRasterizer, AFrameMayBeGivenUpHalfWay) {
  IsolatedRasterizer rasterizer(plugin_path("filler"), options_for_tests(), {});
  const Drawing drawing = triangles(5, 4, 40000, 10000);
  draw(rasterizer, drawing);
  const std::vector<std::uint8_t> right = rasterizer.take().rgb;
  rasterizer.begin_frame(drawing.frame);
  for (int i = 0; i < 3; ++i) rasterizer.polygons(drawing.batches[0]);
  EXPECT_THROW(rasterizer.take(), Error);
  draw(rasterizer, drawing);
  EXPECT_TRUE(rasterizer.take().rgb == right);
}

TEST(IsolatedRasterizer, BlamesTheSurroundingsForARunnerThatIsNotThere) {
  IsolationOptions options = options_for_tests();
  options.runner = "/nowhere/farop-runner";
  try {
    IsolatedRasterizer rasterizer(plugin_path("filler"), options, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::surroundings);
    EXPECT_NE(std::string(error.what()).find("/nowhere/farop-runner"), std::string::npos);
  }
}

TEST(IsolatedRasterizer, LoadsTheBytesThatItLookedAtEvenIfNobodyElseMayReadThem) {
  const std::filesystem::path copy = std::filesystem::path(FAROP_TEST_PLUGINS) / "private-filler.so";
  std::filesystem::copy_file(plugin_path("filler"), copy, std::filesystem::copy_options::overwrite_existing);
  std::filesystem::permissions(copy, std::filesystem::perms::owner_read);
  IsolatedRasterizer rasterizer(copy, options_for_tests(), {});
  std::filesystem::remove(copy);
  EXPECT_EQ(rasterizer.description().name, "filler");
}

}  // namespace
}  // namespace farop
