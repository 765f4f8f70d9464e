// SPDX-License-Identifier: GPL-3.0-or-later
// A runner that the rasterizer has got hold of: whatever it says, the judge ends in words and in time.
#include <gtest/gtest.h>

#include <map>

#include "core/error.h"
#include "unit/isolate/bench.h"

namespace farop {
namespace {

using namespace test;

TEST(Lies, EndInWordsAndNothingIsLeftBehind) {
  const Belongings before = belongings();
  IsolationOptions options = options_for_tests();
  options.runner = std::string(FAROP_TEST_PLUGINS) + "/isolate_lying_runner";
  options.limits.cpu_seconds = 1;
  options.limits.wall_seconds = 0.2;
  std::map<std::string, int> ends;
  for (int seed = 0; seed < 200; ++seed) {
    options.plugin_options["seed"] = std::to_string(seed);
    options.check = seed % 2 == 0;  // findings are welcome, or a breach
    std::string end = "pictures";
    try {
      IsolatedRasterizer rasterizer(plugin_path("filler"), options, {});
      const Drawing drawing = triangles(16, 16, 50, 5);
      for (int i = 0; i < 3; ++i) {
        draw(rasterizer, drawing);
        if (rasterizer.draws_here()) rasterizer.take();
      }
    } catch (const PluginFailure& failure) {
      end = failure.finding().verdict;
      EXPECT_FALSE(failure.finding().message.empty()) << seed;
      for (const char c : std::string(failure.what())) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << seed;
    } catch (const Error& error) {
      end = error.status() == ExitStatus::surroundings ? "surroundings" : "internal";
    }
    ++ends[end];
  }
  // It gets as far as all of these with 200 seeds.
  for (const char* end : {"pictures", "abi.protocol", "abi.status", "abi.load"})
    EXPECT_GT(ends[end], 0) << end;
  const Belongings after = belongings();
  EXPECT_EQ(before.descriptors, after.descriptors);
  EXPECT_EQ(before.children, after.children);
  EXPECT_EQ(before.memories, after.memories);
}

}  // namespace
}  // namespace farop
