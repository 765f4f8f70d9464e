// SPDX-License-Identifier: GPL-3.0-or-later
// The warden: what farop starts to run a rasterizer in. Builds the walls that need a process outside them,
// starts the runner, answers for the calls that its filter hands over, and when the runner or farop has
// ended, leaves nothing behind.
#include <dirent.h>
#include <fcntl.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>

#include "cage.h"
#include "isolate/protocol.h"
#include "walls.h"

namespace farop::isolate {
namespace {

void tell(const WardenMessage& message) {
  // The judge may be gone, or drowning: it learns of the end from the end of the conversation.
  ::send(k_warden_fd, &message, sizeof message, MSG_NOSIGNAL | MSG_DONTWAIT);
}

[[noreturn]] void give_up(const char* what, int error) {
  WardenMessage message;
  message.kind = WardenKind::failed;
  message.error = error;
  std::snprintf(message.what, sizeof message.what, "%s", what);
  tell(message);
  std::_Exit(1);
}

/// The runner's first process in its namespace: when it ends, all of them end.
[[noreturn]] void be_init(pid_t warden) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::prctl(PR_SET_NAME, "farop-init");
  ::signal(SIGCHLD, SIG_IGN);  // reaps
  if (::getppid() != 0 && ::getppid() != warden) std::_Exit(0);
  ::syscall(SYS_close_range, 0, ~0u, 0);
  for (;;) ::pause();
}

class Warden {
 public:
  Warden(const Settings& settings, const char* options) : settings_(settings), options_(options) {}

  int run() {
    const pid_t self = ::getpid();
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
    processes_ = ::open("/proc", O_PATH | O_DIRECTORY | O_CLOEXEC);
    void* const box = ::mmap(nullptr, k_black_box_bytes, PROT_READ, MAP_SHARED, k_black_box_fd, 0);
    if (box != MAP_FAILED) box_ = static_cast<const BlackBox*>(box);
    int namespaces = 0;
    if ((settings_.layers & k_namespaces) != 0) {
      namespaces = enter_namespaces(k_library_fd);
      if (namespaces < 0) give_up("a private root folder", -namespaces);
      // Half a wall may stand: new processes may be in a namespace that wants an init.
      init_ = ::fork();
      if (init_ == 0) be_init(self);
    } else if (::chdir("/") != 0) {
      give_up("chdir", errno);
    }
    std::array<int, 2> pair{};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair.data()) != 0)
      give_up("socketpair", errno);
    runner_ = ::fork();
    if (runner_ < 0) give_up("fork", errno);
    if (runner_ == 0) {
      ::dup2(pair[1], k_warden_fd);
      ::close(k_settings_fd);
      ::syscall(SYS_close_range, k_end_fd, ~0u, 0);
      run_cage(settings_, options_, namespaces);
    }
    ::close(pair[1]);
    handover_ = pair[0];
    watched_ = static_cast<int>(::syscall(SYS_pidfd_open, runner_, 0));
    // The judge's ends of these are to notice when the runner has closed its own.
    for (int fd = 0; fd <= k_control_fd; ++fd) ::close(fd);
    for (int fd = k_library_fd; fd < k_end_fd; ++fd) ::close(fd);
    WardenMessage started;
    started.kind = WardenKind::started;
    started.pid = runner_;
    tell(started);
    attend();
    return 0;
  }

 private:
  void attend() {
    for (;;) {
      std::array<pollfd, 4> all{
          {{k_warden_fd, POLLIN, 0}, {watched_, POLLIN, 0}, {handover_, POLLIN, 0}, {listener_, POLLIN, 0}}};
      // Without a pidfd: look after the runner now and then.
      if (::poll(all.data(), all.size(), watched_ >= 0 ? -1 : 20) < 0 && errno != EINTR) return sweep();
      if (all[0].revents != 0 && !take_order()) return sweep();
      if (all[2].revents != 0) take_listener();
      if ((all[3].revents & POLLIN) != 0) answer_call();
      if ((all[3].revents & (POLLHUP | POLLERR)) != 0) ::close(listener_), listener_ = -1;
      if ((watched_ < 0 || all[1].revents != 0) && reap()) return sweep();
    }
  }

  /// Never with -1, which would mean everybody.
  void kill_runner() const {
    if (runner_ > 0) ::kill(runner_, SIGKILL);
  }

  /// False: the judge is gone.
  bool take_order() {
    std::array<char, 16> order{};
    const ssize_t got = ::recv(k_warden_fd, order.data(), order.size(), MSG_DONTWAIT);
    if (got < 0) return errno == EAGAIN || errno == EINTR;
    if (got == 0) return false;
    if (order[0] == k_kill) kill_runner();
    if (order[0] == k_loaded) loaded_ = true;
    return true;
  }

  void take_listener() {
    char byte = 0;
    iovec part{&byte, 1};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> space{};
    msghdr message{};
    message.msg_iov = &part, message.msg_iovlen = 1;
    message.msg_control = space.data(), message.msg_controllen = space.size();
    const ssize_t got = ::recvmsg(handover_, &message, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
    const cmsghdr* const rights = got > 0 ? CMSG_FIRSTHDR(&message) : nullptr;
    if (rights != nullptr && rights->cmsg_type == SCM_RIGHTS) {
      std::memcpy(&listener_, CMSG_DATA(rights), sizeof listener_);
    }
    ::close(handover_);  // one, or none
    handover_ = -1;
  }

  /// Entries of the runner's list of threads; 0 when it cannot be read.
  std::uint32_t count_threads() const {
    const std::string path = std::to_string(runner_) + "/task";
    const int folder = ::openat(processes_, path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR* const list = folder < 0 ? nullptr : ::fdopendir(folder);
    if (list == nullptr) return 0;
    std::uint32_t count = 0;
    while (const dirent* entry = ::readdir(list)) count += entry->d_name[0] != '.' ? 1 : 0;
    ::closedir(list);
    return count;
  }

  void answer_call() {
    seccomp_notif call{};
    if (::ioctl(listener_, SECCOMP_IOCTL_NOTIF_RECV, &call) != 0) return;
    const int number = call.data.nr;
    seccomp_notif_resp answer{};
    answer.id = call.id;
    Refusal refusal = refusal_of(number);
    bool worth_a_word = true;
    if (number == SCMP_SYS(mmap) && (call.data.args[2] & PROT_EXEC) == 0) {
      // Shared with nobody, there being no other process; but no limit of the kernel counts it.
      const std::uint64_t bytes = call.data.args[1];
      worth_a_word = false;
      if (bytes <= settings_.memory_bytes / 4 - shared_bytes_) {
        shared_bytes_ += bytes;
        answer.flags = SECCOMP_USER_NOTIF_FLAG_CONTINUE;
      } else {
        answer.error = -ENOMEM;
      }
    } else if (refusal.deed == Deed::code && !loaded_) {
      answer.flags = SECCOMP_USER_NOTIF_FLAG_CONTINUE;  // the loader
    } else if (number == SCMP_SYS(clone) && (call.data.args[0] & CLONE_THREAD) != 0) {
      // The flags are registers: nobody can change them between this look and the call.
      refusal.deed = Deed::threads;
      const std::uint32_t threads = settings_.threads <= 1 ? 1 : count_threads();
      if (threads != 0 && threads < settings_.threads) {
        answer.flags = SECCOMP_USER_NOTIF_FLAG_CONTINUE;
      } else {
        answer.error = -EAGAIN;
      }
    } else {
      answer.error = -EPERM;
    }
    if ((answer.flags & SECCOMP_USER_NOTIF_FLAG_CONTINUE) == 0 && worth_a_word) {
      note(number, refusal);
      if (refusal.fatal) kill_runner();
    }
    ::ioctl(listener_, SECCOMP_IOCTL_NOTIF_SEND, &answer);
  }

  /// Each kind once: a rasterizer that tries a million times does not keep the judge busy.
  void note(int call, const Refusal& refusal) {
    const auto bit = 1u << static_cast<unsigned>(refusal.deed);
    if ((noted_ & bit) != 0) return;
    noted_ |= bit;
    WardenMessage message;
    message.kind = WardenKind::refused;
    message.deed = refusal.deed;
    message.call = call;
    message.fatal = refusal.fatal ? 1 : 0;
    message.polygon =
        box_ != nullptr && box_->phase == Phase::polygon ? std::uint32_t{box_->current} : 0xFFFFFFFFu;
    std::snprintf(message.what, sizeof message.what, "%s", call_name(call).c_str());
    tell(message);
  }

  bool reap() {
    int status = 0;
    rusage used{};
    const pid_t ended = ::wait4(runner_, &status, WNOHANG, &used);
    if (ended != runner_) return ended < 0 && errno == ECHILD;
    WardenMessage message;
    message.kind = WardenKind::ended;
    message.wait_status = status;
    const auto nanoseconds = [](const timeval& t) {
      return static_cast<std::uint64_t>(t.tv_sec) * 1000000000u +
             static_cast<std::uint64_t>(t.tv_usec) * 1000u;
    };
    message.cpu_nanoseconds = nanoseconds(used.ru_utime) + nanoseconds(used.ru_stime);
    message.peak_bytes = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
    end_ = message;
    runner_ = -1;
    return true;
  }

  /// Kills what is left, and only then says that all is over.
  void sweep() {
    kill_runner();
    if (init_ > 0) ::kill(init_, SIGKILL);
    // Children of children come back here as their parents die (PR_SET_CHILD_SUBREAPER).
    for (int round = 0; round < 2000; ++round) {
      int status = 0;
      rusage used{};
      pid_t ended = 0;
      while ((ended = ::wait4(-1, &status, WNOHANG, &used)) > 0) {
      }
      if (ended < 0 && errno == ECHILD) break;
      kill_children();
      const timespec moment{0, 1000000};
      ::nanosleep(&moment, nullptr);
    }
    if (end_.kind == WardenKind::ended) tell(end_);
  }

  void kill_children() const {
    const int folder = ::openat(processes_, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR* const list = folder < 0 ? nullptr : ::fdopendir(folder);
    if (list == nullptr) return;
    const pid_t self = ::getpid();
    while (const dirent* entry = ::readdir(list)) {
      const int pid = std::atoi(entry->d_name);
      if (pid <= 0) continue;
      const std::string path = std::string(entry->d_name) + "/stat";
      const int file = ::openat(processes_, path.c_str(), O_RDONLY | O_CLOEXEC);
      std::array<char, 512> text{};
      const ssize_t got = file < 0 ? 0 : ::read(file, text.data(), text.size() - 1);
      if (file >= 0) ::close(file);
      // "pid (name) state ppid ...": the name may hold anything.
      const char* const name_end = got <= 0 ? nullptr : std::strrchr(text.data(), ')');
      int parent = 0;
      char state = 0;
      if (name_end != nullptr && std::sscanf(name_end + 1, " %c %d", &state, &parent) == 2 &&
          parent == self) {
        ::kill(pid, SIGKILL);
      }
    }
    ::closedir(list);
  }

  Settings settings_;
  const char* options_;
  int processes_ = -1;
  const BlackBox* box_ = nullptr;
  pid_t init_ = -1, runner_ = -1;
  int watched_ = -1, handover_ = -1, listener_ = -1;
  bool loaded_ = false;
  std::uint32_t noted_ = 0;
  std::uint64_t shared_bytes_ = 0;  ///< at most a quarter of the memory limit
  WardenMessage end_;
};

int main_of_warden() {
  // Started by hand, there is nobody to talk to.
  int type = 0;
  socklen_t size = sizeof type;
  struct stat status {};
  if (::getsockopt(k_warden_fd, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_SEQPACKET ||
      ::fstat(k_settings_fd, &status) != 0) {
    std::fputs("farop-runner: farop starts this program to run rasterizers in; it is of no use by hand\n",
               stderr);
    return 2;
  }
  for (int fd = k_control_fd; fd < k_end_fd; ++fd) ::fcntl(fd, F_SETFD, FD_CLOEXEC);
  const auto bytes = static_cast<std::size_t>(status.st_size);
  void* const memory = ::mmap(nullptr, bytes + 1, PROT_READ | PROT_WRITE, MAP_PRIVATE, k_settings_fd, 0);
  Settings settings;
  if (memory == MAP_FAILED || bytes < sizeof settings) give_up("settings", errno);
  std::memcpy(&settings, memory, sizeof settings);
  if (settings.magic != k_settings_magic || settings.options_bytes != bytes - sizeof settings) {
    give_up("settings of another version", EPROTO);
  }
  Warden warden(settings, static_cast<const char*>(memory) + sizeof settings);
  return warden.run();
}

}  // namespace
}  // namespace farop::isolate

int main() {
  return farop::isolate::main_of_warden();
}
