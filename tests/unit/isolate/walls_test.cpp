// SPDX-License-Identifier: GPL-3.0-or-later
// Every wall stops what it should stop when it alone stands; and what stands is told.
#include <gtest/gtest.h>
#include <unistd.h>

#include "unit/isolate/bench.h"

namespace farop {
namespace {

using namespace test;

bool layer_stands(char letter) {
  for (const IsolationLayer& layer : probe_isolation(FAROP_RUNNER)) {
    if (layer.id.front() == letter) return layer.holds;
  }
  return false;
}

/// With nothing but the layer.
PluginFinding alone(char letter, const std::string& sin) {
  IsolationOptions options = options_for_tests();
  for (const char other : {'A', 'B', 'C', 'D'}) {
    if (other != letter) options.without += other;
  }
  options.plugin_options["victim"] = std::to_string(::getpid());
  return sin_finding(sin, options);
}

/// The sins of this test leave by an exit status when nothing stops them.
void expect_stopped_by(char letter, const std::string& sin) {
  const PluginFinding open_field = alone('-', sin);
  EXPECT_EQ(open_field.verdict, "crash.exit") << sin << ": nothing to stop: " << open_field.message;
  if (!layer_stands(letter)) GTEST_SKIP() << "this machine has no layer " << letter;
  EXPECT_NE(alone(letter, sin).verdict, "crash.exit") << letter << " does not stop " << sin;
}

TEST(Walls, LimitsStopMemory) {
  expect_stopped_by('A', "much-memory");
}
TEST(Walls, NamespacesStopFiles) {
  expect_stopped_by('B', "read-file");
}
TEST(Walls, NamespacesStopSignals) {
  if (::geteuid() != 0) expect_stopped_by('B', "signal-outside");
}
TEST(Walls, LandlockStopsFiles) {
  expect_stopped_by('C', "read-file");
}
TEST(Walls, FilterStopsProcesses) {
  expect_stopped_by('D', "fork");
}
TEST(Walls, FilterStopsFilesOnceLoaded) {
  expect_stopped_by('D', "read-file");
}
TEST(Walls, FilterStopsCode) {
  expect_stopped_by('D', "code");
}

TEST(Walls, StrictRefusesWhenOneIsMissing) {
  for (const char* without : {"A", "B", "C", "D"}) {
    IsolationOptions options = options_for_tests();
    options.isolation = Isolation::strict;
    options.without = without;
    try {
      IsolatedRasterizer rasterizer(plugin_path("filler"), options, {});
      ADD_FAILURE() << "not refused without " << without;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::surroundings);
      EXPECT_NE(std::string(error.what()).find(std::string("layer ") + without), std::string::npos)
          << error.what();
    }
  }
}

TEST(Walls, StrictDrawsWhenAllStand) {
  for (const char letter : {'A', 'B', 'C', 'D'}) {
    if (!layer_stands(letter)) GTEST_SKIP() << "this machine has no layer " << letter;
  }
  IsolationOptions options = options_for_tests();
  options.isolation = Isolation::strict;
  IsolatedRasterizer rasterizer(plugin_path("filler"), options, {});
  draw(rasterizer, triangles(20, 20, 10, 10));
  for (const IsolationLayer& layer : rasterizer.report().layers)
    EXPECT_TRUE(layer.holds) << layer.id << layer.why;
}

TEST(Walls, NoneStandWhenNotAskedFor) {
  IsolationOptions options = options_for_tests();
  options.isolation = Isolation::off;
  IsolatedRasterizer rasterizer(plugin_path("filler"), options, {});
  const std::vector<IsolationLayer> layers = rasterizer.report().layers;
  ASSERT_EQ(layers.size(), 5u);
  EXPECT_TRUE(layers[0].holds);
  for (std::size_t i = 1; i < layers.size(); ++i) EXPECT_FALSE(layers[i].holds) << layers[i].id;
}

TEST(Walls, ProbesNameEveryLayerAndSayWhyNot) {
  const std::vector<IsolationLayer> layers = probe_isolation(FAROP_RUNNER);
  std::string ids;
  for (const IsolationLayer& layer : layers) {
    ids += layer.id.front();
    EXPECT_TRUE(layer.holds || !layer.why.empty()) << layer.id;
  }
  EXPECT_EQ(ids, "0ABCDE");
}

TEST(Walls, ThreadsAreAllowedUpToTheNumberAskedFor) {
  IsolationOptions options = options_for_tests();
  options.limits.threads = 2;
  EXPECT_EQ(sin_finding("thread", options).verdict, "pass");
  options.limits.threads = 1;
  EXPECT_EQ(sin_finding("thread", options).verdict, "limit.threads");
}

}  // namespace
}  // namespace farop
