// SPDX-License-Identifier: GPL-3.0-or-later
// Every wall stops what it should stop when it alone stands; and what stands is told.
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <map>
#include <sstream>

#include "unit/isolate/bench.h"

namespace farop {
namespace {

using namespace test;

/// As the runner says: whether the layer does what it should is for the tests to see.
bool layer_stands(char letter) {
  IsolationOptions options = options_for_tests();
  const IsolatedRasterizer rasterizer(plugin_path("filler"), options, {});
  for (const IsolationLayer& layer : rasterizer.report().layers) {
    if (layer.id.front() == letter) return layer.holds;
  }
  return false;
}

/// With nothing but the layer.
PluginFinding alone(char letter, const std::string& sin) {
  IsolationOptions options = options_for_tests();
  for (const char other : {'A', 'B', 'C', 'D', 'E'}) {
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
  expect_stopped_by('B', "signal-outside");
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
      // One that this machine has not may be named before the one that was left out.
      bool named = false;
      for (const char letter : {'A', 'B', 'C', 'D'}) {
        const bool missing = without[0] == letter || !layer_stands(letter);
        named = named || (missing && std::string(error.what()).find(std::string("layer ") + letter) !=
                                         std::string::npos);
      }
      EXPECT_TRUE(named) << error.what();
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
  for (const IsolationLayer& layer : rasterizer.report().layers) {
    EXPECT_TRUE(layer.holds || layer.id.front() == 'E') << layer.id << layer.why;
  }
}

TEST(Walls, NoneStandWhenNotAskedFor) {
  IsolationOptions options = options_for_tests();
  options.isolation = Isolation::off;
  IsolatedRasterizer rasterizer(plugin_path("filler"), options, {});
  const std::vector<IsolationLayer> layers = rasterizer.report().layers;
  ASSERT_EQ(layers.size(), 6u);
  EXPECT_TRUE(layers[0].holds);
  for (std::size_t i = 1; i < layers.size(); ++i) EXPECT_FALSE(layers[i].holds) << layers[i].id;
}

TEST(Walls, ThatAreMissingAreToldInALine) {
  const std::vector<IsolationLayer> all = {{"0 process", true, "", ""},      {"A limits", true, "", ""},
                                           {"B namespaces", true, "", ""},   {"C landlock", true, "7", ""},
                                           {"D seccomp", true, "quiet", ""}, {"E cgroup", false, "none", ""}};
  EXPECT_EQ(missing_walls(all), "");
  std::vector<IsolationLayer> some = all;
  some[2].holds = some[3].holds = false;
  some[2].why = "Operation not permitted", some[3].why = "Function not implemented";
  EXPECT_EQ(
      missing_walls(some),
      "walls around rasterizers that are missing here: B namespaces (Operation not permitted), C landlock "
      "(Function not implemented); `farop doctor` says more");
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

/// Calls that get through whatever their arguments, or with arguments of -1; all others must not.
const std::vector<long> k_allowed = {SYS_brk,
                                     SYS_clock_getres,
                                     SYS_clock_gettime,
                                     SYS_clock_nanosleep,
                                     SYS_close,
                                     SYS_close_range,
                                     SYS_exit,
                                     SYS_exit_group,
                                     SYS_fstat,
                                     SYS_futex,
                                     SYS_getcpu,
                                     SYS_getegid,
                                     SYS_geteuid,
                                     SYS_getgid,
                                     SYS_getpgrp,
                                     SYS_getpid,
                                     SYS_getppid,
                                     SYS_getrandom,
                                     SYS_getrlimit,
                                     SYS_getrusage,
                                     SYS_getsid,
                                     SYS_gettid,
                                     SYS_gettimeofday,
                                     SYS_getuid,
                                     SYS_lseek,
                                     SYS_madvise,
                                     SYS_membarrier,
                                     SYS_mincore,
                                     SYS_mremap,
                                     SYS_munmap,
                                     SYS_nanosleep,
                                     SYS_pause,
                                     SYS_poll,
                                     SYS_ppoll,
                                     SYS_pread64,
                                     SYS_pselect6,
                                     SYS_read,
                                     SYS_readv,
                                     SYS_restart_syscall,
                                     SYS_rseq,
                                     SYS_rt_sigaction,
                                     SYS_rt_sigpending,
                                     SYS_rt_sigprocmask,
                                     SYS_rt_sigreturn,
                                     SYS_rt_sigsuspend,
                                     SYS_rt_sigtimedwait,
                                     SYS_sched_getaffinity,
                                     SYS_sched_getparam,
                                     SYS_sched_getscheduler,
                                     SYS_sched_yield,
                                     SYS_select,
                                     SYS_set_robust_list,
                                     SYS_set_tid_address,
                                     SYS_sigaltstack,
                                     SYS_sysinfo,
                                     SYS_time,
                                     SYS_times,
                                     SYS_uname,
                                     SYS_newfstatat};

/// Calls that no program makes by accident: the end.
const std::vector<long> k_fatal = {SYS_ptrace,
                                   SYS_process_vm_readv,
                                   SYS_process_vm_writev,
                                   SYS_kcmp,
                                   SYS_process_madvise,
                                   SYS_pidfd_getfd,
                                   SYS_io_uring_setup,
                                   SYS_io_uring_enter,
                                   SYS_io_uring_register,
                                   SYS_keyctl,
                                   SYS_add_key,
                                   SYS_request_key,
                                   SYS_userfaultfd,
                                   SYS_bpf,
                                   SYS_perf_event_open,
                                   SYS_mount,
                                   SYS_umount2,
                                   SYS_pivot_root,
                                   SYS_chroot,
                                   SYS_unshare,
                                   SYS_setns,
                                   SYS_fsopen,
                                   SYS_fsconfig,
                                   SYS_fsmount,
                                   SYS_fspick,
                                   SYS_open_tree,
                                   SYS_move_mount,
                                   SYS_mount_setattr,
                                   SYS_open_by_handle_at,
                                   SYS_init_module,
                                   SYS_finit_module,
                                   SYS_delete_module,
                                   SYS_kexec_load,
                                   SYS_kexec_file_load,
                                   SYS_swapon,
                                   SYS_swapoff,
                                   SYS_reboot,
                                   SYS_acct,
                                   SYS_quotactl,
                                   SYS_iopl,
                                   SYS_ioperm,
                                   SYS_modify_ldt};

TEST(Walls, EveryOtherSystemCallIsRefused) {
  if (!layer_stands('D')) GTEST_SKIP() << "this machine has no layer D";
  IsolationOptions options = options_for_tests();
  options.without = "ABC";
  for (const long call : k_allowed) options.plugin_options["skip"] += std::to_string(call) + " ";
  for (const long call : k_fatal) options.plugin_options["skip"] += std::to_string(call) + " ";
  // uretprobe and its successor: kernels let them pass every filter, and answer with SIGILL.
  options.plugin_options["skip"] += "335 336 ";
  options.plugin_options["sin"] = "every-call";
  IsolatedRasterizer rasterizer(plugin_path("sinner"), options, {});
  draw(rasterizer, triangles(16, 16, 5, 5));
  std::istringstream lines(rasterizer.report().out);
  int count = 0;
  for (long call = 0, error = 0; lines >> call >> error; ++count) {
    const bool refused =
        error == EPERM || error == EACCES || error == ENOSYS || (call == SYS_clone && error == EAGAIN);
    EXPECT_TRUE(refused) << "call " << call << ": error " << error;
  }
  EXPECT_EQ(count, 520 - 2 - static_cast<int>(k_allowed.size() + k_fatal.size()));
}

TEST(Walls, WhatNobodyCallsByAccidentIsTheEnd) {
  if (!layer_stands('D')) GTEST_SKIP() << "this machine has no layer D";
  for (const long call : k_fatal) {
    IsolationOptions options = options_for_tests();
    options.without = "ABC";
    options.plugin_options["number"] = std::to_string(call);
    const PluginFinding finding = sin_finding("call", options);
    EXPECT_EQ(finding.verdict, "limit.syscall") << call;
    EXPECT_TRUE(finding.fatal) << call;
    EXPECT_EQ(finding.polygon, 2u) << call;
  }
}

/// From here on this process and its children get `error` from the calls. Architecture is not looked at:
/// this is a test.
void deny(const std::map<long, int>& errors, long prctl_option = -1) {
  std::vector<sock_filter> program;
  const auto load = [&](std::size_t offset) {
    program.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
  };
  const auto give = [&](int error) {
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error)));
  };
  load(offsetof(seccomp_data, nr));
  for (const auto& [call, error] : errors) {
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
    give(error);
  }
  if (prctl_option >= 0) {
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_prctl, 0, 3));
    load(offsetof(seccomp_data, args));
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(prctl_option), 0, 1));
    give(EINVAL);
  }
  program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  ASSERT_EQ(::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), 0);
  ASSERT_EQ(::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter), 0);
}

/// In a process that lacks what `deny` takes away: draws, names a crash, and says which layers stand.
std::string standing_layers(const std::map<long, int>& errors, long prctl_option = -1) {
  int pipe[2];
  if (::pipe(pipe) != 0) return "no pipe";
  const pid_t child = ::fork();
  if (child == 0) {
    std::string text;
    try {
      deny(errors, prctl_option);
      IsolatedRasterizer honest(plugin_path("filler"), options_for_tests(), {});
      draw(honest, triangles(16, 16, 5, 5));
      for (const IsolationLayer& layer : honest.report().layers) {
        if (layer.holds && layer.id.front() != 'E') text += layer.id.front();
      }
      text += " " + sin_finding("segv").verdict + " " + sin_finding("fork").verdict;
    } catch (const std::exception& error) {
      text = error.what();
    }
    if (::write(pipe[1], text.data(), text.size()) < 0) ::_exit(1);
    ::_exit(0);
  }
  ::close(pipe[1]);
  std::string text(4096, '\0');
  const ssize_t got = ::read(pipe[0], text.data(), text.size());
  text.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
  ::close(pipe[0]);
  ::waitpid(child, nullptr, 0);
  return text;
}

TEST(Walls, OnAMachineThatForbidsSomeTheOthersStand) {
  std::string all;
  for (const IsolationLayer& layer : probe_isolation(FAROP_RUNNER)) {
    if (layer.holds && layer.id.front() != 'E') all += layer.id.front();
  }
  if (all != "0ABCD") GTEST_SKIP() << "this machine has only " << all;
  EXPECT_EQ(standing_layers({}), "0ABCD crash.segv limit.syscall");
  // As in a container with the usual profile.
  EXPECT_EQ(standing_layers({{SYS_unshare, EPERM}}), "0ACD crash.segv limit.syscall");
  EXPECT_EQ(standing_layers({{SYS_landlock_create_ruleset, ENOSYS}}), "0ABD crash.segv limit.syscall");
  EXPECT_EQ(standing_layers({{SYS_landlock_create_ruleset, EOPNOTSUPP}, {SYS_unshare, ENOSPC}}),
            "0AD crash.segv limit.syscall");
  // Namespaces, but no root folder of its own.
  EXPECT_EQ(standing_layers({{SYS_mount, EPERM}}), "0ACD crash.segv limit.syscall");
  EXPECT_EQ(standing_layers({{SYS_pivot_root, EPERM}}), "0ACD crash.segv limit.syscall");
  EXPECT_EQ(standing_layers({{SYS_umount2, EPERM}}),
            "cannot run a rasterizer beside farop: a private root folder: Operation not permitted");
  // Without a filter a child is started; the limits stop it where they count, and the sweep ends it.
  const std::string unfiltered = standing_layers({{SYS_seccomp, EINVAL}}, PR_SET_SECCOMP);
  EXPECT_EQ(unfiltered.substr(0, 16), "0ABC crash.segv ") << unfiltered;
  // Where the filter may not hand calls over, they fail without a word.
  EXPECT_EQ(standing_layers({{SYS_seccomp, ENOSYS}}), "0ABCD crash.segv pass");
}

}  // namespace
}  // namespace farop
