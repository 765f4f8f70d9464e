// SPDX-License-Identifier: GPL-3.0-or-later
// What a rasterizer does wrong is named, with the polygon.
#include <gtest/gtest.h>

#include <filesystem>

#include "unit/isolate/bench.h"

namespace farop {
namespace {

using namespace test;

struct Sin {
  const char* name;
  const char* verdict;
  const char* words;  ///< part of the message
  bool names_polygon = true;
  int sinful_frame = 0, frames = 1;
};

std::ostream& operator<<(std::ostream& out, const Sin& sin) {
  return out << sin.name;
}

class Sins : public testing::TestWithParam<Sin> {};

TEST_P(Sins, AreNamed) {
  const Sin& sin = GetParam();
  IsolationOptions options = options_for_tests();
  const std::string name = sin.name;
  if (name == "loop") options.limits.cpu_seconds = 0.3;
  if (name.ends_with("-forever")) options.limits.cpu_seconds = 0.3, options.limits.wall_seconds = 1;
  if (name == "pause" || name == "stop" || name == "hang-at-end-frame") options.limits.wall_seconds = 0.5;
  const PluginFinding finding = sin_finding(name, options, sin.sinful_frame, sin.frames);
  EXPECT_EQ(finding.verdict, sin.verdict) << finding.message;
  EXPECT_NE(finding.message.find(sin.words), std::string::npos) << finding.message;
  if (sin.names_polygon) {
    EXPECT_EQ(finding.polygon, 2u) << finding.message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Sins,
    testing::Values(
        Sin{"segv", "crash.segv", "null pointer: it wrote to address 0 in polygon 2 (3 corners, first at "},
        Sin{"read-null", "crash.segv", "null pointer: it read address 0"},
        Sin{"wild", "crash.segv", "address 0x123456789000"}, Sin{"fpe", "crash.fpe", "division by zero"},
        Sin{"ill", "crash.ill", "illegal instruction"}, Sin{"abort", "crash.abort", "sinner: about to abort"},
        Sin{"stack", "crash.stack", "stack"}, Sin{"exit", "crash.exit", "exit status 0 in polygon 2"},
        Sin{"_exit", "crash.exit", "exit status 7"}, Sin{"pthread_exit", "crash.exit", "pthread_exit"},
        Sin{"throw", "crash.abort", "an exception (std::runtime_error) left the rasterizer in polygon 2"},
        Sin{"loop", "limit.time", "0.3 s of CPU time in polygon 2"}, Sin{"pause", "limit.time", "0.5 s"},
        Sin{"stop", "limit.time", "0.5 s"},
        Sin{"status", "abi.status", "a request it cannot serve (FAROP_E_UNSUPPORTED): sinner: told to fail"},
        Sin{"before", "oob.write-before", "row -1, column ", false},
        Sin{"after", "oob.write-after", "row 16, column "},
        Sin{"before", "oob.write-before", "row -1, column ", true, 1, 2},
        Sin{"after", "oob.write-after", "row 16, column ", false, 1, 2},
        Sin{"stride", "oob.write-stride", "row 0, 0 bytes behind its last pixel", false},
        Sin{"far", "oob.write-after", "behind the last"}, Sin{"input", "oob.write-input", "only be read"},
        Sin{"read-beyond", "oob.read", "number 1 behind the last"},
        Sin{"old-frame", "oob.write-after-end", "end_frame() had returned", true, 1, 2},
        Sin{"old-input", "oob.read", "polygon() that had returned", true, 1, 2},
        Sin{"fork", "limit.syscall", "start a process (clone) in polygon 2"},
        Sin{"thread", "limit.threads", "threads"}, Sin{"exec", "limit.syscall", "run a program"},
        Sin{"socket", "limit.syscall", "use the network (socket)"},
        Sin{"ptrace", "limit.syscall", "another process (ptrace)"},
        Sin{"write-file", "limit.syscall", "write, remove or rename a file (openat)"},
        Sin{"code", "limit.syscall", "make code while running (mmap)"},
        Sin{"kill-parent", "limit.syscall", "signal"}, Sin{"kill-self", "limit.syscall", "signal"},
        Sin{"memory", "limit.memory", "out of memory (limit 256 MB)"},
        Sin{"print", "limit.output", "64 KiB", false}, Sin{"log", "limit.output", "64 KiB", false},
        Sin{"log-forever", "limit.time", "in polygon 2"}, Sin{"print-forever", "limit.time", "in polygon 2"},
        Sin{"close", "abi.protocol", "descriptors", false}, Sin{"forge", "abi.protocol", "", false},
        Sin{"write-control", "abi.protocol", "(write)"}, Sin{"unmap", "crash.segv", "frame"},
        Sin{"float", "abi.float-state", "denormal", false}, Sin{"handler", "abi.signals", "signal", false},
        Sin{"hang-at-end-frame", "limit.time", "in end_frame", false},
        Sin{"hang-in-destroy", "pass", "", false}, Sin{"", "pass", "", false}));

TEST(Findings, ATraceNamesTheFunctionsOfTheRasterizer) {
  const PluginFinding finding = sin_finding("segv");
  ASSERT_GE(finding.trace.size(), 2u);
  EXPECT_NE(finding.trace[0].find("sin_of("), std::string::npos) << finding.trace[0];
  EXPECT_NE(finding.trace[1].find("polygon("), std::string::npos) << finding.trace[1];
}

TEST(Findings, OneVertexTooManyIsNoticedWithEveryPolygonOnItsOwn) {
  IsolationOptions options = options_for_tests();
  options.guard_every_polygon = true;
  for (const char* sin : {"read-one-beyond", "old-input-soon"}) {
    const PluginFinding finding = sin_finding(sin, options);
    EXPECT_EQ(finding.verdict, "oob.read") << finding.message;
    EXPECT_EQ(finding.polygon, 2u);
    EXPECT_EQ(sin_finding(sin).verdict, "pass") << sin << ": nothing to notice";
  }
}

TEST(Findings, LargeFramesHaveAnApronToo) {
  EXPECT_EQ(sin_finding("before", options_for_tests(), 0, 1, 250).verdict, "oob.write-before");
  EXPECT_EQ(sin_finding("stride", options_for_tests(), 0, 1, 250).verdict, "oob.write-stride");
  EXPECT_EQ(sin_finding("after", options_for_tests(), 1, 2, 220).verdict, "oob.write-after");
  EXPECT_EQ(sin_finding("", options_for_tests(), 0, 2, 250).verdict, "pass");
}

/// The memory is used again: what one frame has spoiled is not told of the next ones.
TEST(Findings, AreOfTheFrameThatTheyHappenedIn) {
  for (const char* sin : {"stride", "before", "after"}) {
    IsolationOptions options = options_for_tests();
    options.plugin_options["sin"] = sin;
    options.plugin_options["frame"] = std::string(sin) == "after" ? "1" : "0";  // where no guard page is hit
    IsolatedRasterizer rasterizer(plugin_path("sinner"), options, {});
    std::size_t found = 0;
    for (int i = 0; i < 7; ++i) {
      try {
        draw(rasterizer, triangles(16, i == 4 ? 15 : 16, 5, 2));
      } catch (const PluginFailure&) {
        ++found;
      }
    }
    EXPECT_EQ(found + rasterizer.findings().size(), 1u) << sin;
  }
}

TEST(Findings, LoadingIsPartOfIt) {
  const auto verdict = [](const std::string& path, const std::string& sin) {
    IsolationOptions options = options_for_tests();
    options.limits.cpu_seconds = 0.3;
    options.plugin_options["load-sin"] = sin;
    try {
      IsolatedRasterizer rasterizer(path, options, {});
    } catch (const PluginFailure& failure) {
      EXPECT_EQ(failure.status(), ExitStatus::plugin);
      EXPECT_FALSE(failure.finding().message.empty());
      return failure.finding().verdict;
    }
    return std::string("pass");
  };
  EXPECT_EQ(verdict(plugin_path("sinner"), ""), "pass");
  EXPECT_EQ(verdict(plugin_path("sinner"), "segv"), "abi.load");
  EXPECT_EQ(verdict(plugin_path("sinner"), "exit"), "abi.load");
  EXPECT_EQ(verdict(plugin_path("sinner"), "loop"), "abi.load");
  EXPECT_EQ(verdict(plugin_path("sinner"), "null"), "abi.version");
  EXPECT_EQ(verdict("/nowhere/at-all.so", ""), "abi.load");
  EXPECT_EQ(verdict("/dev/zero", ""), "abi.load");
  EXPECT_EQ(verdict(FAROP_TEST_PLUGINS, ""), "abi.load");
}

TEST(Findings, OutputIsKeptUpToALimitAndMadeSafeToPrint) {
  IsolationOptions options = options_for_tests();
  options.plugin_options["sin"] = "print";
  IsolatedRasterizer rasterizer(plugin_path("sinner"), options, {});
  draw(rasterizer, triangles(16, 16, 5, 2));
  EXPECT_EQ(rasterizer.report().out, std::string(64 << 10, 'x'));
  EXPECT_EQ(rasterizer.report().err, "");
}

TEST(Findings, ThePictureIsRightWhateverElseHappened) {
  IsolatedRasterizer honest(plugin_path("sinner"), options_for_tests(), {});
  const Drawing drawing = triangles(16, 16, 5, 2);
  draw(honest, drawing);
  const std::vector<std::uint8_t> right = honest.take().rgb;
  for (const char* sin : {"before", "stride", "fork", "socket", "print", "float", "handler", "thread"}) {
    IsolationOptions options = options_for_tests();
    options.plugin_options["sin"] = sin;
    IsolatedRasterizer rasterizer(plugin_path("sinner"), options, {});
    draw(rasterizer, drawing);
    EXPECT_EQ(rasterizer.take().rgb, right) << sin;
    EXPECT_EQ(rasterizer.findings().size(), 1u) << sin;
  }
}

}  // namespace
}  // namespace farop
