// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/script_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "core/error.h"

namespace farop::sipp {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool k_can_limit_address_space = false;  // sanitizers reserve terabytes for their shadow
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr bool k_can_limit_address_space = false;
#else
constexpr bool k_can_limit_address_space = true;
#endif
#else
constexpr bool k_can_limit_address_space = true;
#endif

constexpr std::size_t k_block = std::size_t{1} << 18;
constexpr int k_watch_interval_ms = 10;
/// The interpreter stops itself at its limit and says where; the process is stopped only if that fails.
constexpr double k_grace_seconds = 0.7;
constexpr double k_longest_silence_seconds = 10;

double now() {
  timespec t{};
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct MemoryUse {
  std::uint64_t address_space = 0, own = 0;  ///< bytes; own: resident and not of a file
};

MemoryUse memory_of(int process) {
  MemoryUse use;
  char path[64];
  std::snprintf(path, sizeof path, process == 0 ? "/proc/self/statm" : "/proc/%d/statm", process);
  std::FILE* file = std::fopen(path, "re");
  if (file == nullptr) return use;
  unsigned long long size = 0, resident = 0, shared = 0;
  if (std::fscanf(file, "%llu %llu %llu", &size, &resident, &shared) == 3) {
    const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    use.address_space = size * page;
    use.own = (resident - std::min(shared, resident)) * page;
  }
  std::fclose(file);
  return use;
}

void set_limit(int resource, std::uint64_t value) {
  rlimit limit{};
  ::getrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
  limit.rlim_cur = limit.rlim_max = std::min<rlim_t>(value, limit.rlim_max);
  ::setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

void restrict_child(std::uint64_t memory_bytes) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  for (const int number : {SIGINT, SIGTERM, SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL})
    std::signal(number, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  // What a sanitizer finds must be seen.
  const int streams = k_can_limit_address_space ? 3 : 2;
  for (int standard = 0; standard < streams && nothing >= 0; ++standard) ::dup2(nothing, standard);
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_FSIZE, 0);
  set_limit(RLIMIT_NPROC, 0);
  if (k_can_limit_address_space) set_limit(RLIMIT_AS, memory_of(0).address_space + memory_bytes);
}

}  // namespace

void ChildOutput::write(const void* data, std::size_t size) {
  if (buffer_.size() + size > k_block) flush();
  if (size < k_block) {
    buffer_.append(static_cast<const char*>(data), size);
    return;
  }
  std::string_view rest(static_cast<const char*>(data), size);
  while (!rest.empty()) {
    const ssize_t n = ::write(descriptor_, rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw std::runtime_error("nobody listens");
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
}

void ChildOutput::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t n = ::write(descriptor_, rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw std::runtime_error("nobody listens");
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
  buffer_.clear();
}

ScriptProcess::ScriptProcess(const std::function<void(ChildOutput&)>& work, double seconds,
                             std::uint64_t memory_mb)
    : memory_mb_(memory_mb), memory_limit_(std::min<std::uint64_t>(memory_mb, std::uint64_t{1} << 40) << 20) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw Error(ExitStatus::surroundings, fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  }
  ::fcntl(ends[1], F_SETPIPE_SZ, 1 << 20);  // fewer changes of process; as good without
  deadline_ = now() + seconds + k_grace_seconds;
  std::fflush(nullptr);
  child_ = ::fork();
  if (child_ < 0) {
    const int reason = errno;
    ::close(ends[0]);
    ::close(ends[1]);
    throw Error(ExitStatus::surroundings,
                fmt::format("cannot start a process for the script: {}", std::strerror(reason)));
  }
  if (child_ == 0) {
    ::close(ends[0]);
    restrict_child(memory_limit_);
    try {
      ChildOutput output(ends[1]);
      work(output);
      output.flush();
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);  // without the destructors and exit handlers of a program that lives on elsewhere
  }
  ::close(ends[1]);
  descriptor_ = ends[0];
  ::fcntl(descriptor_, F_SETFL, O_NONBLOCK);
  memory_at_start_ = memory_of(0).own;  // the child has the same pages, shared until one writes
  buffer_.reserve(k_block);
}

ScriptProcess::~ScriptProcess() {
  kill();
  ::close(descriptor_);
}

void ScriptProcess::kill() {
  if (child_ <= 0) return;
  ::kill(child_, SIGKILL);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
}

void ScriptProcess::watch_memory() {
  const std::uint64_t own = memory_of(child_).own;
  if (own <= memory_at_start_ + memory_limit_) return;
  kill();
  throw ChildLost(ChildLost::Reason::too_much_memory,
                  fmt::format("the script needs more than {} MB", memory_mb_));
}

void ScriptProcess::lost() {
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    throw ChildLost(ChildLost::Reason::crashed,
                    number == SIGSEGV || number == SIGBUS
                        ? "the script is nested too deeply, or broke the interpreter"
                        : fmt::format("the script broke the interpreter ({})", ::strsignal(number)));
  }
  throw ChildLost(ChildLost::Reason::crashed, "the interpreter of the script gave up");
}

void ScriptProcess::fill() {
  buffer_.resize(k_block);
  position_ = 0;
  double last_sign = now();
  for (;;) {
    const ssize_t n = ::read(descriptor_, buffer_.data(), buffer_.size());
    if (n > 0) {
      buffer_.resize(static_cast<std::size_t>(n));
      return;
    }
    if (n == 0) lost();
    if (errno != EAGAIN && errno != EINTR) lost();
    pollfd wait{descriptor_, POLLIN, 0};
    if (::poll(&wait, 1, k_watch_interval_ms) > 0) continue;
    watch_memory();
    const double time = now();
    const bool late = clock_runs_ ? time > deadline_ : time - last_sign > k_longest_silence_seconds;
    if (!late) continue;
    kill();
    throw ChildLost(ChildLost::Reason::too_long, "the script runs longer than it may");
  }
}

void ScriptProcess::read(void* data, std::size_t size) {
  char* to = static_cast<char*>(data);
  while (size > 0) {
    if (position_ == buffer_.size()) fill();
    const std::size_t n = std::min(size, buffer_.size() - position_);
    std::memcpy(to, buffer_.data() + position_, n);
    position_ += n;
    to += n;
    size -= n;
  }
}

}  // namespace farop::sipp
