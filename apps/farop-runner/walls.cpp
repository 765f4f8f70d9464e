// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls.h"

#include <fcntl.h>
#include <grp.h>
#include <linux/capability.h>
#include <linux/landlock.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>

namespace farop::isolate {
namespace {

/// Where the loader looks on the systems we know. What is missing is left out.
constexpr std::array k_library_folders = {"/lib",
                                          "/lib64",
                                          "/lib32",
                                          "/usr/lib",
                                          "/usr/lib64",
                                          "/usr/lib32",
                                          "/usr/local/lib",
                                          "/usr/local/lib64",
                                          "/usr/libexec/gcc",
                                          "/etc/alternatives"};  // links to libraries, in Debian
constexpr const char* k_loader_cache = "/etc/ld.so.cache";

int result(int value) {
  return value == 0 ? 0 : errno;
}

int set_limit(__rlimit_resource what, rlim_t value, rlim_t hard) {
  rlimit now{};
  if (::getrlimit(what, &now) == 0)
    value = std::min(value, now.rlim_max), hard = std::min(hard, now.rlim_max);
  const rlimit limit{value, hard};
  return result(::setrlimit(what, &limit));
}

bool write_text(const char* path, const std::string& text) {
  const int file = ::open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool done = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::close(file);
  return done;
}

constexpr int k_spaces = CLONE_NEWNS | CLONE_NEWPID | CLONE_NEWNET | CLONE_NEWIPC | CLONE_NEWUTS;

/// With a user namespace: what a user without privileges needs to have the others.
int unshare_as_user() {
  const uid_t uid = ::geteuid();
  const gid_t gid = ::getegid();
  // The files below belong to root while the process may not be dumped.
  ::prctl(PR_SET_DUMPABLE, 1);
  if (::unshare(CLONE_NEWUSER | k_spaces) != 0) return errno;
  const auto map = [](unsigned id) { return std::to_string(id) + " " + std::to_string(id) + " 1"; };
  write_text("/proc/self/setgroups", "deny");
  if (!write_text("/proc/self/uid_map", map(uid)) || !write_text("/proc/self/gid_map", map(gid)))
    return EPERM;
  return 0;
}

bool make_folders(const std::string& path) {
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    const std::string part = path.substr(0, slash);
    if (::mkdir(part.c_str(), 0755) != 0 && errno != EEXIST) return false;
    if (slash == std::string::npos) return true;
  }
}

/// A folder or file of the outer root, read-only, under `root`. Symbolic links are made anew.
bool show(const std::string& root, const std::string& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) return true;  // not on this system
  const std::string inside = root + path;
  make_folders(inside.substr(0, inside.rfind('/')));
  if (S_ISLNK(status.st_mode)) {
    std::string target(4096, '\0');
    const ssize_t length = ::readlink(path.c_str(), target.data(), target.size());
    if (length <= 0) return false;
    target.resize(static_cast<std::size_t>(length));
    return ::symlink(target.c_str(), inside.c_str()) == 0;
  }
  if (S_ISDIR(status.st_mode)) {
    if (!make_folders(inside)) return false;
  } else {
    const int file = ::open(inside.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0444);
    if (file < 0) return false;
    ::close(file);
  }
  if (::mount(path.c_str(), inside.c_str(), nullptr, MS_BIND | MS_REC, nullptr) != 0) return false;
  struct statvfs mounted {};
  if (::statvfs(inside.c_str(), &mounted) != 0) return false;
  // Flags that the outer mount has may not be taken away in a user namespace.
  unsigned long flags = MS_BIND | MS_REMOUNT | MS_RDONLY | MS_NOSUID | MS_NODEV;
  if ((mounted.f_flag & ST_NOEXEC) != 0) flags |= MS_NOEXEC;
  if ((mounted.f_flag & ST_NOATIME) != 0) flags |= MS_NOATIME;
  if ((mounted.f_flag & ST_NODIRATIME) != 0) flags |= MS_NODIRATIME;
  if ((mounted.f_flag & ST_RELATIME) != 0) flags |= MS_RELATIME;
  return ::mount(nullptr, inside.c_str(), nullptr, flags, nullptr) == 0;
}

bool copy_library(int from, const std::string& to, std::uint64_t bytes) {
  const int file = ::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0555);
  if (file < 0) return false;
  std::array<char, 65536> block{};
  std::uint64_t done = 0;
  while (done < bytes) {
    const ssize_t got = ::pread(from, block.data(), block.size(), static_cast<off_t>(done));
    if (got <= 0 || ::write(file, block.data(), static_cast<std::size_t>(got)) != got) break;
    done += static_cast<std::uint64_t>(got);
  }
  ::close(file);
  return done == bytes;
}

int build_root(int library_fd) {
  struct stat library {};
  if (::fstat(library_fd, &library) != 0) return errno;
  const auto bytes = static_cast<std::uint64_t>(library.st_size);
  if (::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return errno;
  const std::string options = "mode=755,size=" + std::to_string(bytes + (std::uint64_t{1} << 20));
  std::string root;
  for (const char* place : {"/tmp", "/var/tmp", "/mnt", "/run"}) {
    if (::mount("farop", place, "tmpfs", MS_NOSUID | MS_NODEV, options.c_str()) == 0) {
      root = place;
      break;
    }
  }
  if (root.empty()) return errno;
  for (const char* folder : k_library_folders) {
    if (!show(root, folder)) return errno;
  }
  if (!show(root, k_loader_cache)) return errno;
  if (!copy_library(library_fd, root + k_library_inside, bytes)) return errno;
  if (::mkdir((root + "/empty").c_str(), 0555) != 0) return errno;
  // The old root ends up on top of the new one and is taken off.
  if (::chdir(root.c_str()) != 0 || ::syscall(SYS_pivot_root, ".", ".") != 0) {
    const int error = errno;
    return ::chdir("/") == 0 ? error : -error;
  }
  if (::umount2(".", MNT_DETACH) != 0 || ::chdir("/empty") != 0) return -errno;
  if (::mount(nullptr, "/", nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY | MS_NOSUID | MS_NODEV, nullptr) != 0) {
    return -errno;
  }
  return 0;
}

// ---- Landlock. Debian 12's header stops at version 2; later words are repeated here. ---------------------

struct LandlockRules {
  std::uint64_t files, net, scoped;
};
constexpr std::uint64_t k_landlock_truncate = 1u << 14, k_landlock_ioctl_dev = 1u << 15;
constexpr std::uint64_t k_landlock_tcp = 3;     // bind, connect
constexpr std::uint64_t k_landlock_scopes = 3;  // abstract sockets, signals

bool allow_reading(int rules, const char* path, std::uint64_t access) {
  const int place = ::open(path, O_PATH | O_CLOEXEC);
  if (place < 0) return errno == ENOENT;
  landlock_path_beneath_attr beneath{};
  beneath.allowed_access = access;
  beneath.parent_fd = place;
  const bool done = ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0) == 0;
  ::close(place);
  return done;
}

// ---- seccomp --------------------------------------------------------------------------------------------

/// Calls that every program makes and that reach nobody else.
constexpr std::array k_harmless = {SCMP_SYS(brk),
                                   SCMP_SYS(clock_getres),
                                   SCMP_SYS(clock_gettime),
                                   SCMP_SYS(clock_nanosleep),
                                   SCMP_SYS(close),
                                   SCMP_SYS(close_range),
                                   SCMP_SYS(exit),
                                   SCMP_SYS(exit_group),
                                   SCMP_SYS(fstat),
                                   SCMP_SYS(futex),
                                   SCMP_SYS(getcpu),
                                   SCMP_SYS(getegid),
                                   SCMP_SYS(geteuid),
                                   SCMP_SYS(getgid),
                                   SCMP_SYS(getpgrp),
                                   SCMP_SYS(getpid),
                                   SCMP_SYS(getppid),
                                   SCMP_SYS(getrandom),
                                   SCMP_SYS(getrlimit),
                                   SCMP_SYS(getrusage),
                                   SCMP_SYS(getsid),
                                   SCMP_SYS(gettid),
                                   SCMP_SYS(gettimeofday),
                                   SCMP_SYS(getuid),
                                   SCMP_SYS(lseek),
                                   SCMP_SYS(membarrier),
                                   SCMP_SYS(mincore),
                                   SCMP_SYS(mremap),
                                   SCMP_SYS(munmap),
                                   SCMP_SYS(nanosleep),
                                   SCMP_SYS(pause),
                                   SCMP_SYS(poll),
                                   SCMP_SYS(ppoll),
                                   SCMP_SYS(pread64),
                                   SCMP_SYS(pselect6),
                                   SCMP_SYS(read),
                                   SCMP_SYS(readv),
                                   SCMP_SYS(restart_syscall),
                                   SCMP_SYS(rseq),
                                   SCMP_SYS(rt_sigaction),
                                   SCMP_SYS(rt_sigpending),
                                   SCMP_SYS(rt_sigprocmask),
                                   SCMP_SYS(rt_sigreturn),
                                   SCMP_SYS(rt_sigsuspend),
                                   SCMP_SYS(rt_sigtimedwait),
                                   SCMP_SYS(sched_getaffinity),
                                   SCMP_SYS(sched_getparam),
                                   SCMP_SYS(sched_getscheduler),
                                   SCMP_SYS(sched_yield),
                                   SCMP_SYS(select),
                                   SCMP_SYS(set_robust_list),
                                   SCMP_SYS(set_tid_address),
                                   SCMP_SYS(sigaltstack),
                                   SCMP_SYS(sysinfo),
                                   SCMP_SYS(time),
                                   SCMP_SYS(times),
                                   SCMP_SYS(uname)};

/// Needed to load a library, and only for that.
constexpr std::array k_loading = {
    SCMP_SYS(access),  SCMP_SYS(faccessat),  SCMP_SYS(faccessat2), SCMP_SYS(getcwd),   SCMP_SYS(getdents64),
    SCMP_SYS(lstat),   SCMP_SYS(newfstatat), SCMP_SYS(prctl),      SCMP_SYS(readlink), SCMP_SYS(readlinkat),
    SCMP_SYS(seccomp), SCMP_SYS(stat),       SCMP_SYS(statfs),     SCMP_SYS(fstatfs),  SCMP_SYS(statx)};

/// Legal questions with a "no" for an answer, not worth a word: libraries ask them in passing.
constexpr std::array k_quietly_refused = {
    SCMP_SYS(arch_prctl),    SCMP_SYS(capset),         SCMP_SYS(chdir),
    SCMP_SYS(fallocate),     SCMP_SYS(fchdir),         SCMP_SYS(flock),
    SCMP_SYS(ftruncate),     SCMP_SYS(getpeername),    SCMP_SYS(getsockname),
    SCMP_SYS(getsockopt),    SCMP_SYS(ioctl),          SCMP_SYS(mlock),
    SCMP_SYS(mlockall),      SCMP_SYS(personality),    SCMP_SYS(sched_setaffinity),
    SCMP_SYS(sched_setattr), SCMP_SYS(sched_setparam), SCMP_SYS(sched_setscheduler),
    SCMP_SYS(setpgid),       SCMP_SYS(setpriority),    SCMP_SYS(setrlimit),
    SCMP_SYS(setsid),        SCMP_SYS(setsockopt),     SCMP_SYS(setuid),
    SCMP_SYS(setgid),        SCMP_SYS(setresuid),      SCMP_SYS(setresgid),
    SCMP_SYS(setgroups),     SCMP_SYS(shutdown),       SCMP_SYS(umask)};

struct Watched {
  int call;
  Deed deed;
  bool fatal;
};

/// Refused in every form. (clone, open, kill, write, mmap ... are refused in some forms: rules of their own.)
constexpr std::array k_watched = {Watched{SCMP_SYS(fork), Deed::process, false},
                                  Watched{SCMP_SYS(vfork), Deed::process, false},
                                  Watched{SCMP_SYS(execve), Deed::program, false},
                                  Watched{SCMP_SYS(execveat), Deed::program, false},
                                  Watched{SCMP_SYS(socket), Deed::network, false},
                                  Watched{SCMP_SYS(socketpair), Deed::network, false},
                                  Watched{SCMP_SYS(connect), Deed::network, false},
                                  Watched{SCMP_SYS(bind), Deed::network, false},
                                  Watched{SCMP_SYS(listen), Deed::network, false},
                                  Watched{SCMP_SYS(accept), Deed::network, false},
                                  Watched{SCMP_SYS(accept4), Deed::network, false},
                                  Watched{SCMP_SYS(sendto), Deed::control, false},
                                  Watched{SCMP_SYS(sendmmsg), Deed::control, false},
                                  Watched{SCMP_SYS(recvfrom), Deed::control, false},
                                  Watched{SCMP_SYS(recvmmsg), Deed::control, false},
                                  Watched{SCMP_SYS(dup), Deed::control, false},
                                  Watched{SCMP_SYS(dup2), Deed::control, false},
                                  Watched{SCMP_SYS(dup3), Deed::control, false},
                                  Watched{SCMP_SYS(creat), Deed::write_file, false},
                                  Watched{SCMP_SYS(unlink), Deed::write_file, false},
                                  Watched{SCMP_SYS(unlinkat), Deed::write_file, false},
                                  Watched{SCMP_SYS(rename), Deed::write_file, false},
                                  Watched{SCMP_SYS(renameat), Deed::write_file, false},
                                  Watched{SCMP_SYS(renameat2), Deed::write_file, false},
                                  Watched{SCMP_SYS(mkdir), Deed::write_file, false},
                                  Watched{SCMP_SYS(mkdirat), Deed::write_file, false},
                                  Watched{SCMP_SYS(rmdir), Deed::write_file, false},
                                  Watched{SCMP_SYS(link), Deed::write_file, false},
                                  Watched{SCMP_SYS(linkat), Deed::write_file, false},
                                  Watched{SCMP_SYS(symlink), Deed::write_file, false},
                                  Watched{SCMP_SYS(symlinkat), Deed::write_file, false},
                                  Watched{SCMP_SYS(mknod), Deed::write_file, false},
                                  Watched{SCMP_SYS(mknodat), Deed::write_file, false},
                                  Watched{SCMP_SYS(truncate), Deed::write_file, false},
                                  Watched{SCMP_SYS(chmod), Deed::write_file, false},
                                  Watched{SCMP_SYS(fchmod), Deed::write_file, false},
                                  Watched{SCMP_SYS(fchmodat), Deed::write_file, false},
                                  Watched{SCMP_SYS(chown), Deed::write_file, false},
                                  Watched{SCMP_SYS(lchown), Deed::write_file, false},
                                  Watched{SCMP_SYS(fchown), Deed::write_file, false},
                                  Watched{SCMP_SYS(fchownat), Deed::write_file, false},
                                  Watched{SCMP_SYS(kill), Deed::signal, false},
                                  Watched{SCMP_SYS(tkill), Deed::signal, false},
                                  Watched{SCMP_SYS(rt_sigqueueinfo), Deed::signal, false},
                                  Watched{SCMP_SYS(rt_tgsigqueueinfo), Deed::signal, false},
                                  Watched{SCMP_SYS(pidfd_open), Deed::signal, false},
                                  Watched{SCMP_SYS(pidfd_send_signal), Deed::signal, false},
                                  Watched{SCMP_SYS(shmget), Deed::memory, false},
                                  Watched{SCMP_SYS(shmat), Deed::memory, false},
                                  Watched{SCMP_SYS(semget), Deed::memory, false},
                                  Watched{SCMP_SYS(msgget), Deed::memory, false},
                                  Watched{SCMP_SYS(mq_open), Deed::memory, false},
                                  Watched{SCMP_SYS(memfd_create), Deed::memory, false},
                                  Watched{SCMP_SYS(ptrace), Deed::other_process, true},
                                  Watched{SCMP_SYS(process_vm_readv), Deed::other_process, true},
                                  Watched{SCMP_SYS(process_vm_writev), Deed::other_process, true},
                                  Watched{SCMP_SYS(process_madvise), Deed::other_process, true},
                                  Watched{SCMP_SYS(pidfd_getfd), Deed::other_process, true},
                                  Watched{SCMP_SYS(kcmp), Deed::other_process, true},
                                  Watched{SCMP_SYS(io_uring_setup), Deed::kernel, true},
                                  Watched{SCMP_SYS(io_uring_enter), Deed::kernel, true},
                                  Watched{SCMP_SYS(io_uring_register), Deed::kernel, true},
                                  Watched{SCMP_SYS(keyctl), Deed::kernel, true},
                                  Watched{SCMP_SYS(add_key), Deed::kernel, true},
                                  Watched{SCMP_SYS(request_key), Deed::kernel, true},
                                  Watched{SCMP_SYS(userfaultfd), Deed::kernel, true},
                                  Watched{SCMP_SYS(bpf), Deed::kernel, true},
                                  Watched{SCMP_SYS(perf_event_open), Deed::kernel, true},
                                  Watched{SCMP_SYS(mount), Deed::kernel, true},
                                  Watched{SCMP_SYS(umount2), Deed::kernel, true},
                                  Watched{SCMP_SYS(pivot_root), Deed::kernel, true},
                                  Watched{SCMP_SYS(chroot), Deed::kernel, true},
                                  Watched{SCMP_SYS(unshare), Deed::kernel, true},
                                  Watched{SCMP_SYS(setns), Deed::kernel, true},
                                  Watched{SCMP_SYS(fsopen), Deed::kernel, true},
                                  Watched{SCMP_SYS(fsconfig), Deed::kernel, true},
                                  Watched{SCMP_SYS(fsmount), Deed::kernel, true},
                                  Watched{SCMP_SYS(fspick), Deed::kernel, true},
                                  Watched{SCMP_SYS(open_tree), Deed::kernel, true},
                                  Watched{SCMP_SYS(move_mount), Deed::kernel, true},
                                  Watched{SCMP_SYS(mount_setattr), Deed::kernel, true},
                                  Watched{SCMP_SYS(open_by_handle_at), Deed::kernel, true},
                                  Watched{SCMP_SYS(init_module), Deed::kernel, true},
                                  Watched{SCMP_SYS(finit_module), Deed::kernel, true},
                                  Watched{SCMP_SYS(delete_module), Deed::kernel, true},
                                  Watched{SCMP_SYS(kexec_load), Deed::kernel, true},
                                  Watched{SCMP_SYS(kexec_file_load), Deed::kernel, true},
                                  Watched{SCMP_SYS(swapon), Deed::kernel, true},
                                  Watched{SCMP_SYS(swapoff), Deed::kernel, true},
                                  Watched{SCMP_SYS(reboot), Deed::kernel, true},
                                  Watched{SCMP_SYS(acct), Deed::kernel, true},
                                  Watched{SCMP_SYS(quotactl), Deed::kernel, true},
                                  Watched{SCMP_SYS(iopl), Deed::kernel, true},
                                  Watched{SCMP_SYS(ioperm), Deed::kernel, true},
                                  Watched{SCMP_SYS(modify_ldt), Deed::kernel, true}};

/// Older kernels end a thread only.
std::uint32_t the_end() {
  return ::seccomp_api_get() >= 3 ? SCMP_ACT_KILL_PROCESS : SCMP_ACT_KILL_THREAD;
}

/// A filter under construction. The first failure sticks.
class Filter {
 public:
  explicit Filter(std::uint32_t otherwise) : context_(::seccomp_init(otherwise)) {
    if (context_ == nullptr) {
      error_ = ENOMEM;
      return;
    }
    // 32-bit entries and x32 numbers mean other calls than the ones looked at here.
    check(::seccomp_attr_set(context_, SCMP_FLTATR_ACT_BADARCH, the_end()));
    // A binary tree: some two dozen calls a second are made, but some rasterizers allocate a lot.
    ::seccomp_attr_set(context_, SCMP_FLTATR_CTL_OPTIMIZE, 2);
  }
  ~Filter() {
    if (context_ != nullptr) ::seccomp_release(context_);
  }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;

  /// Numbers that this machine does not have are negative: nothing to do.
  void add(std::uint32_t action, int call, std::initializer_list<scmp_arg_cmp> when = {}) {
    if (error_ != 0 || call < 0) return;
    const int code = ::seccomp_rule_add_array(context_, action, call, static_cast<unsigned>(when.size()),
                                              when.size() == 0 ? nullptr : when.begin());
    if (code != -EEXIST && code != -EACCES) check(code);  // EACCES: the same as what happens anyway
  }
  int load(bool watched, int& listener) {
    listener = -1;
    if (error_ != 0) return error_;
    check(::seccomp_load(context_));
    if (error_ == 0 && watched) listener = ::seccomp_notify_fd(context_);
    return error_;
  }

 private:
  void check(int code) {
    if (error_ == 0 && code != 0) error_ = -code;
  }
  scmp_filter_ctx context_;
  int error_ = 0;
};

scmp_arg_cmp masked(unsigned argument, std::uint64_t mask, std::uint64_t value) {
  return {argument, SCMP_CMP_MASKED_EQ, mask, value};
}
scmp_arg_cmp compare(unsigned argument, scmp_compare how, std::uint64_t value) {
  return {argument, how, value, 0};
}

constexpr std::uint64_t k_write_flags = O_ACCMODE | O_CREAT | O_TRUNC;

}  // namespace

int drop_capabilities() {
  for (int capability = 0; ::prctl(PR_CAPBSET_READ, capability) >= 0; ++capability) {
    ::prctl(PR_CAPBSET_DROP, capability);  // without CAP_SETPCAP there is nothing to gain from them either
  }
  ::prctl(PR_CAP_AMBIENT, PR_CAP_AMBIENT_CLEAR_ALL, 0, 0, 0);
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, 2> none{};
  return result(static_cast<int>(::syscall(SYS_capset, &header, none.data())));
}

int give_up_privileges() {
  int error = 0;
  if (::geteuid() == 0 || ::getuid() == 0) {
    if (::setgroups(0, nullptr) != 0 || ::setresgid(k_nobody, k_nobody, k_nobody) != 0 ||
        ::setresuid(k_nobody, k_nobody, k_nobody) != 0) {
      error = errno;
    }
  }
  const int kept = drop_capabilities();
  return error != 0 ? error : kept;
}

int limit_resources(std::uint64_t memory_bytes, std::uint32_t threads) {
  constexpr std::uint64_t reserved = std::uint64_t{1} << 30;  // no-man's-land, frames, libraries
  int error = 0;
  const auto keep = [&](int code) {
    if (error == 0) error = code;
  };
  keep(set_limit(RLIMIT_CORE, 0, 0));
  keep(set_limit(RLIMIT_FSIZE, 0, 0));
  keep(set_limit(RLIMIT_NOFILE, 16, 16));
  keep(set_limit(RLIMIT_MEMLOCK, 0, 0));
  keep(set_limit(RLIMIT_MSGQUEUE, 0, 0));
  keep(set_limit(RLIMIT_STACK, rlim_t{64} << 20, rlim_t{64} << 20));
  if (memory_bytes != 0) {
    keep(set_limit(RLIMIT_DATA, memory_bytes, memory_bytes));
    keep(set_limit(RLIMIT_AS, memory_bytes + reserved, memory_bytes + reserved));
  }
  // Counts all processes of a user: with threads it would depend on what else that user runs.
  if (threads <= 1) keep(set_limit(RLIMIT_NPROC, 0, 0));
  return error;
}

int enter_namespaces(int library_fd) {
  int error = EPERM;
  if (::geteuid() == 0) error = result(::unshare(k_spaces));
  if (error != 0) {
    if (::geteuid() == 0) {
      const int kept = give_up_privileges();
      if (kept != 0) return kept;
    }
    error = unshare_as_user();
  }
  if (error == 0) ::sethostname("farop", 5);
  return error != 0 ? error : build_root(library_fd);
}

int restrict_files(std::int32_t& abi) {
  abi = 0;
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return errno == 0 ? ENOSYS : errno;
  abi = static_cast<std::int32_t>(version);
  LandlockRules wanted{(1u << 13) - 1, 0, 0};
  std::size_t size = sizeof wanted.files;
  if (abi >= 2) wanted.files |= LANDLOCK_ACCESS_FS_REFER;
  if (abi >= 3) wanted.files |= k_landlock_truncate;
  if (abi >= 4) wanted.net = k_landlock_tcp, size = offsetof(LandlockRules, scoped);
  if (abi >= 5) wanted.files |= k_landlock_ioctl_dev;
  if (abi >= 6) wanted.scoped = k_landlock_scopes, size = sizeof wanted;
  const long rules = ::syscall(SYS_landlock_create_ruleset, &wanted, size, 0);
  if (rules < 0) return errno;
  const int fd = static_cast<int>(rules);
  int error = 0;
  for (const char* folder : k_library_folders) {
    if (error == 0 && !allow_reading(fd, folder,
                                     LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR |
                                         LANDLOCK_ACCESS_FS_EXECUTE)) {
      error = errno;
    }
  }
  for (const char* file : {k_loader_cache, k_library_inside}) {
    if (error == 0 && !allow_reading(fd, file, LANDLOCK_ACCESS_FS_READ_FILE)) error = errno;
  }
  if (error == 0 && ::syscall(SYS_landlock_restrict_self, fd, 0) != 0) error = errno;
  ::close(fd);
  return error;
}

int filter_calls(std::uint32_t threads, bool watched, int& listener) {
  const auto nothing = SCMP_ACT_ERRNO(ENOSYS);
  const auto no = SCMP_ACT_ERRNO(EPERM);
  const std::uint32_t word = watched ? SCMP_ACT_NOTIFY : no;
  const std::uint32_t fatal_word = watched ? SCMP_ACT_NOTIFY : the_end();
  const auto self = static_cast<std::uint64_t>(::getpid());

  Filter filter(nothing);
  for (const int call : k_harmless) filter.add(SCMP_ACT_ALLOW, call);
  for (const int call : k_loading) filter.add(SCMP_ACT_ALLOW, call);
  for (const int call : k_quietly_refused) filter.add(no, call);
  for (const Watched& w : k_watched) filter.add(w.fatal ? fatal_word : word, w.call);

  for (const int call : {SCMP_SYS(write), SCMP_SYS(writev)}) {
    filter.add(SCMP_ACT_ALLOW, call, {compare(0, SCMP_CMP_LE, 2)});
    filter.add(word, call, {compare(0, SCMP_CMP_GT, 2)});
  }
  for (const int call : {SCMP_SYS(sendmsg), SCMP_SYS(recvmsg)}) {
    filter.add(SCMP_ACT_ALLOW, call, {compare(0, SCMP_CMP_LE, k_warden_fd)});
    filter.add(word, call, {compare(0, SCMP_CMP_GT, k_warden_fd)});
  }
  // What allocators ask for. MADV_REMOVE would empty memory that the judge reads, too.
  for (const int advice : {MADV_NORMAL, MADV_RANDOM, MADV_SEQUENTIAL, MADV_WILLNEED, MADV_DONTNEED, MADV_FREE,
                           MADV_DONTFORK, MADV_DOFORK, MADV_HUGEPAGE, MADV_NOHUGEPAGE, MADV_DONTDUMP,
                           MADV_DODUMP, MADV_COLD, MADV_PAGEOUT, MADV_POPULATE_READ, MADV_POPULATE_WRITE}) {
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(madvise),
               {compare(2, SCMP_CMP_EQ, static_cast<std::uint64_t>(advice))});
  }
  for (const int advice : {MADV_REMOVE, MADV_MERGEABLE, MADV_UNMERGEABLE, MADV_HWPOISON}) {
    filter.add(no, SCMP_SYS(madvise), {compare(2, SCMP_CMP_EQ, static_cast<std::uint64_t>(advice))});
  }
  const auto open_rules = [&](int call, unsigned flags) {
    filter.add(SCMP_ACT_ALLOW, call, {masked(flags, k_write_flags, 0)});
    filter.add(word, call, {masked(flags, O_ACCMODE, O_WRONLY)});
    filter.add(word, call, {masked(flags, O_ACCMODE, O_RDWR)});
    filter.add(word, call, {masked(flags, O_ACCMODE | O_CREAT, O_CREAT)});
    filter.add(word, call, {masked(flags, O_ACCMODE | O_CREAT | O_TRUNC, O_TRUNC)});
  };
  open_rules(SCMP_SYS(open), 1);
  open_rules(SCMP_SYS(openat), 2);
  // raise() and abort() use tgkill. Not SIGKILL: who ended the runner that way must remain clear.
  const int raise_call = SCMP_SYS(tgkill);
  filter.add(SCMP_ACT_ALLOW, raise_call, {compare(0, SCMP_CMP_EQ, self), compare(2, SCMP_CMP_NE, SIGKILL)});
  filter.add(word, raise_call, {compare(0, SCMP_CMP_EQ, self), compare(2, SCMP_CMP_EQ, SIGKILL)});
  filter.add(word, raise_call, {compare(0, SCMP_CMP_NE, self)});
  // Asking a descriptor what it is, as interpreters do with every file they open.
  for (const int command : {F_GETFD, F_GETFL}) {
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(fcntl),
               {compare(1, SCMP_CMP_EQ, static_cast<std::uint64_t>(command))});
  }
  for (const int command : {F_DUPFD, F_SETFD}) {
    filter.add(no, SCMP_SYS(fcntl), {compare(1, SCMP_CMP_EQ, static_cast<std::uint64_t>(command))});
  }
  filter.add(no, SCMP_SYS(fcntl), {compare(1, SCMP_CMP_GT, F_GETFL)});
  // Looking up limits is harmless, setting them is not.
  filter.add(SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), {compare(2, SCMP_CMP_EQ, 0)});
  filter.add(no, SCMP_SYS(prlimit64), {compare(2, SCMP_CMP_NE, 0)});
  // Threads: pthread_create() tries clone3 first, whose flags a filter cannot see, and is told that there is
  // none. (The flags come first on every machine but s390.)
  filter.add(nothing, SCMP_SYS(clone3));
  filter.add(word, SCMP_SYS(clone), {masked(0, CLONE_THREAD, 0)});
  filter.add(watched       ? SCMP_ACT_NOTIFY
             : threads > 1 ? SCMP_ACT_ALLOW
                           : SCMP_ACT_ERRNO(EAGAIN),
             SCMP_SYS(clone), {masked(0, CLONE_THREAD, CLONE_THREAD)});
  // Code: the loader maps it now; whether it is still now only the warden knows. Shared anonymous memory
  // escapes RLIMIT_DATA: the warden counts it.
  const std::uint32_t code = watched ? SCMP_ACT_NOTIFY : SCMP_ACT_ALLOW;
  filter.add(SCMP_ACT_ALLOW, SCMP_SYS(mmap), {masked(2, PROT_EXEC, 0), masked(3, MAP_ANONYMOUS, 0)});
  filter.add(SCMP_ACT_ALLOW, SCMP_SYS(mmap),
             {masked(2, PROT_EXEC, 0), masked(3, MAP_ANONYMOUS | MAP_TYPE, MAP_ANONYMOUS | MAP_PRIVATE)});
  filter.add(watched ? SCMP_ACT_NOTIFY : SCMP_ACT_ERRNO(ENOMEM), SCMP_SYS(mmap),
             {masked(2, PROT_EXEC, 0), masked(3, MAP_ANONYMOUS | MAP_TYPE, MAP_ANONYMOUS | MAP_SHARED)});
  filter.add(code, SCMP_SYS(mmap), {masked(2, PROT_EXEC, PROT_EXEC)});
  for (const int call : {SCMP_SYS(mprotect), SCMP_SYS(pkey_mprotect)}) {
    filter.add(SCMP_ACT_ALLOW, call, {masked(2, PROT_EXEC, 0)});
    filter.add(code, call, {masked(2, PROT_EXEC, PROT_EXEC)});
  }
  return filter.load(watched, listener);
}

int filter_calls_further(bool watched) {
  const auto hidden = SCMP_ACT_ERRNO(EACCES);
  const auto no = SCMP_ACT_ERRNO(EPERM);
  Filter filter(SCMP_ACT_ALLOW);  // what the first filter says goes on
  for (const int call : k_loading) {
    if (call != SCMP_SYS(newfstatat) && call != SCMP_SYS(prctl)) filter.add(hidden, call);
  }
  filter.add(hidden, SCMP_SYS(newfstatat),
             {masked(3, AT_EMPTY_PATH, 0)});  // fstat() of newer libraries stays
  filter.add(no, SCMP_SYS(prctl), {compare(0, SCMP_CMP_NE, PR_SET_NAME)});
  filter.add(hidden, SCMP_SYS(open), {masked(1, k_write_flags, 0)});
  filter.add(hidden, SCMP_SYS(openat), {masked(2, k_write_flags, 0)});
  if (!watched) {
    for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mprotect), SCMP_SYS(pkey_mprotect)}) {
      filter.add(no, call, {masked(2, PROT_EXEC, PROT_EXEC)});
    }
  }
  int none = -1;
  return filter.load(false, none);
}

Refusal refusal_of(int call) {
  for (const Watched& w : k_watched) {
    if (w.call == call) return {w.deed, w.fatal};
  }
  switch (call) {
    case SCMP_SYS(open):
    case SCMP_SYS(openat):
      return {Deed::write_file, false};
    case SCMP_SYS(tgkill):
      return {Deed::signal, false};
    case SCMP_SYS(write):
    case SCMP_SYS(writev):
    case SCMP_SYS(sendmsg):
    case SCMP_SYS(recvmsg):
      return {Deed::control, false};
    case SCMP_SYS(clone):
      return {Deed::process, false};
    case SCMP_SYS(mmap):
    case SCMP_SYS(mprotect):
    case SCMP_SYS(pkey_mprotect):
      return {Deed::code, false};
    default:
      return {Deed::kernel, true};
  }
}

std::string call_name(int call) {
  char* name = ::seccomp_syscall_resolve_num_arch(::seccomp_arch_native(), call);
  std::string text = name == nullptr ? "call " + std::to_string(call) : name;
  std::free(name);
  return text;
}

}  // namespace farop::isolate
