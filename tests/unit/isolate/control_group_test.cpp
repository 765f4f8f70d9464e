// SPDX-License-Identifier: GPL-3.0-or-later
// Layer E in a copy of the kernel's files, as few machines that tests run on share out control groups; and in
// the kernel itself where they do.
#include "isolate/control_group.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "unit/isolate/bench.h"

namespace farop {
namespace {

namespace fs = std::filesystem;
using namespace test;
using isolate::ControlGroup;

/// A folder that stands for `/`.
class FakeRoot {
 public:
  /// `own`: the line of /proc/self/cgroup. `folder`: what of the hierarchy is mounted.
  explicit FakeRoot(const std::string& own = "0::/session/farop.scope\n", const std::string& folder = "/") {
    write("proc/self/cgroup", own);
    write("proc/self/mountinfo", "22 1 8:1 / / rw,relatime shared:1 - ext4 /dev/sda1 rw\n30 22 0:26 " +
                                     folder +
                                     " /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n");
    write("sys/fs/cgroup/cgroup.subtree_control", "cpu memory pids\n");
    write("sys/fs/cgroup/session/cgroup.subtree_control", "cpu memory pids\n");
    write("sys/fs/cgroup/session/farop.scope/cgroup.subtree_control", "\n");
  }
  ~FakeRoot() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  FakeRoot(const FakeRoot&) = delete;
  FakeRoot& operator=(const FakeRoot&) = delete;

  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((path_ / file).parent_path());
    std::ofstream(path_ / file) << text;
  }
  std::string path() const { return path_.string(); }
  std::string session() const { return path() + "/sys/fs/cgroup/session"; }

 private:
  fs::path path_ = fs::path(testing::TempDir()) / ("cgroup-" + std::to_string(::getpid()));
};

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// As the kernel does with the files of a group.
void remove_files(const std::string& group) {
  for (const auto& entry : fs::directory_iterator(group)) fs::remove(entry);
}

TEST(ControlGroup, LimitsStandBesideTheGroupOfThisProcess) {
  const FakeRoot root;
  std::string path;
  {
    ControlGroup group({std::uint64_t{1} << 30, 5}, root.path());
    ASSERT_TRUE(group.there()) << group.why();
    path = group.path();
    EXPECT_EQ(fs::path(path).parent_path(), root.session());
    EXPECT_EQ(text_of(path + "/memory.max"), std::to_string((5u << 28) + (256u << 20)));
    EXPECT_EQ(text_of(path + "/memory.swap.max"), "0");
    EXPECT_EQ(text_of(path + "/memory.oom.group"), "1");
    EXPECT_EQ(text_of(path + "/pids.max"), "5");
    EXPECT_TRUE(group.add(1234));
    EXPECT_EQ(text_of(path + "/cgroup.procs"), "1234");
    EXPECT_EQ(text_of(root.session() + "/cgroup.subtree_control"), "cpu memory pids\n") << "is not ours";
    remove_files(path);
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(ControlGroup, StandsBelowTheGroupOfThisProcessWhereThatSharesOut) {
  const FakeRoot root("12:pids:/else\n0::/\n");
  const ControlGroup group({0, 1}, root.path());
  ASSERT_TRUE(group.there()) << group.why();
  EXPECT_EQ(fs::path(group.path()).parent_path(), root.path() + "/sys/fs/cgroup");
  EXPECT_EQ(text_of(group.path() + "/memory.max"), "max");
}

TEST(ControlGroup, IsFoundWhereOnlyAPartOfTheHierarchyIsMounted) {
  const FakeRoot root("0::/machine/box/session/farop.scope\n", "/machine/box");
  const ControlGroup group({0, 1}, root.path());
  ASSERT_TRUE(group.there()) << group.why();
  EXPECT_EQ(fs::path(group.path()).parent_path(), root.session());
}

TEST(ControlGroup, IsMissingForAReason) {
  {
    const FakeRoot root;
    root.write("proc/self/mountinfo", "25 22 0:23 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n");
    EXPECT_EQ(ControlGroup({0, 1}, root.path()).why(), "no cgroup v2 is mounted");
  }
  {
    const FakeRoot root("4:memory:/\n");
    EXPECT_EQ(ControlGroup({0, 1}, root.path()).why(),
              "this process is in none of the groups that are mounted");
  }
  {
    const FakeRoot root;
    root.write("sys/fs/cgroup/session/cgroup.subtree_control", "cpu pids\n");
    EXPECT_EQ(ControlGroup({0, 1}, root.path()).why(),
              "/sys/fs/cgroup/session does not share out memory and pids");
  }
  {
    const FakeRoot root;
    fs::remove_all(root.session());
    root.write("sys/fs/cgroup/session", "no folder");
    EXPECT_NE(ControlGroup({0, 1}, root.path()).why(), "");
    EXPECT_FALSE(ControlGroup({0, 1}, root.path()).there());
  }
}

TEST(ControlGroup, KnowsWhatTheKernelDidToIt) {
  const FakeRoot root;
  const ControlGroup group({0, 1}, root.path());
  ASSERT_TRUE(group.there());
  EXPECT_EQ(group.killed_for_memory(), 0u);
  EXPECT_FALSE(group.peak_bytes());
  root.write("sys/fs/cgroup/session/" + fs::path(group.path()).filename().string() + "/memory.events",
             "low 0\nhigh 0\nmax 17\noom 1\noom_kill 2\noom_group_kill 1\n");
  std::ofstream(group.path() + "/memory.peak") << "123456\n";
  EXPECT_EQ(group.killed_for_memory(), 2u);
  EXPECT_EQ(group.peak_bytes(), 123456u);
}

TEST(ControlGroup, RemovesThoseThatKilledProgramsHaveLeft) {
  const FakeRoot root;
  const pid_t gone = ::fork();
  if (gone == 0) ::_exit(0);
  ::waitpid(gone, nullptr, 0);
  const std::string left = root.session() + "/farop-" + std::to_string(gone) + "-0";
  const std::string alive = root.session() + "/farop-" + std::to_string(::getppid()) + "-0";
  fs::create_directory(left), fs::create_directory(alive);
  const ControlGroup group({0, 1}, root.path());
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(alive));
}

TEST(ControlGroup, IsProbedByWhatItShouldStop) {
  const FakeRoot root;
  const IsolationLayer layer = isolate::probe_control_group(root.path());
  EXPECT_EQ(layer.id, "E cgroup");
  EXPECT_FALSE(layer.holds);
  EXPECT_EQ(layer.why, "it is there, but what it should stop went through") << "files limit nothing";
}

TEST(ControlGroup, HoldsTheRunnerAndExplainsItsEnd) {
  const FakeRoot root;
  IsolationOptions options = options_for_tests();
  options.group_root = root.path();
  IsolatedRasterizer rasterizer(plugin_path("filler"), options, {});
  EXPECT_EQ(rasterizer.report().layers.back().id, "E cgroup");
  ASSERT_TRUE(rasterizer.report().layers.back().holds) << rasterizer.report().layers.back().why;
  std::string group;
  for (const auto& entry : fs::directory_iterator(root.session())) {
    if (entry.path().filename().string().starts_with("farop-")) group = entry.path();
  }
  ASSERT_FALSE(group.empty());
  EXPECT_EQ(text_of(group + "/pids.max"), "1");
  const int runner = std::stoi(text_of(group + "/cgroup.procs"));
  EXPECT_TRUE(processes_running(own_runner()).contains(runner));
  draw(rasterizer, triangles(20, 20, 10, 10));

  // What the kernel does when a group has no memory left.
  std::ofstream(group + "/memory.events") << "oom 1\noom_kill 1\n";
  std::ofstream(group + "/memory.peak") << (std::uint64_t{7} << 40);
  const Drawing frame = triangles(20, 20, 10, 10);
  rasterizer.begin_frame(frame.frame);
  ::kill(runner, SIGKILL);
  try {
    rasterizer.end_frame();
    ADD_FAILURE() << "nobody noticed";
  } catch (const PluginFailure& failure) {
    EXPECT_EQ(failure.finding().verdict, "limit.memory");
    EXPECT_TRUE(failure.finding().message.starts_with("out of memory (limit ")) << failure.finding().message;
  }
  EXPECT_EQ(rasterizer.report().peak_bytes, std::uint64_t{7} << 40);
}

TEST(ControlGroup, IsNotMadeWhenNotAskedFor) {
  const FakeRoot root;
  for (const bool off : {false, true}) {
    IsolationOptions options = options_for_tests();
    options.group_root = root.path();
    if (off) {
      options.isolation = Isolation::off;
    } else {
      options.without = "E";
    }
    const IsolatedRasterizer rasterizer(plugin_path("filler"), options, {});
    EXPECT_FALSE(rasterizer.report().layers.back().holds);
    EXPECT_EQ(rasterizer.report().layers.back().why, "not asked for");
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(root.session()), fs::directory_iterator()), 2);
}

TEST(ControlGroup, StopsProcessesWhereTheMachineHasIt) {
  const IsolationLayer layer = isolate::probe_control_group();
  if (!layer.holds) GTEST_SKIP() << "this machine has no layer E: " << layer.why;
  ControlGroup group({std::uint64_t{64} << 20, 1});
  ASSERT_TRUE(group.there());
  const std::string path = group.path();
  EXPECT_TRUE(group.remove());
  EXPECT_FALSE(fs::exists(path));
}

}  // namespace
}  // namespace farop
