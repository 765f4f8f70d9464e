// SPDX-License-Identifier: GPL-3.0-or-later
#include "isolate/runner_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <utility>

namespace farop::isolate {
namespace {

using std::chrono::milliseconds;

constexpr int k_pipe_bytes = 1 << 20;  // what anybody may have

[[noreturn]] void cannot(const char* what, int error) {
  throw Error(ExitStatus::surroundings,
              fmt::format("cannot run a rasterizer beside farop: {}: {}", what, std::strerror(error)));
}

struct Pair {
  OwnedDescriptor ours, theirs;
};

Pair socket_pair() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) cannot("socketpair", errno);
  return {OwnedDescriptor(ends[0]), OwnedDescriptor(ends[1])};
}

Pair output_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) cannot("pipe", errno);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  // Floods come in fewer, larger parts. Where the user has too many pipes already, it stays as it is.
  ::fcntl(ends[0], F_SETPIPE_SZ, k_pipe_bytes);
  return {OwnedDescriptor(ends[0]), OwnedDescriptor(ends[1])};
}

std::string packed_options(const std::map<std::string, std::string>* options) {
  std::string text;
  if (options == nullptr) return text;
  for (const auto& [key, value] : *options) {
    text.append(key.c_str(), key.size() + 1);  // with its NUL
    text.append(value.c_str(), value.size() + 1);
  }
  return text;
}

SharedMemory packed_settings(Settings settings, const std::map<std::string, std::string>* options) {
  const std::string text = packed_options(options);
  settings.magic = k_settings_magic;
  settings.options_bytes = text.size();
  SharedMemory memory("farop-settings", sizeof settings + text.size());
  memory.write(0, std::as_bytes(std::span(&settings, 1)));
  memory.write(sizeof settings, std::as_bytes(std::span(text)));
  memory.make_constant();
  return memory;
}

/// File actions that put descriptors where the runner expects them.
class Placement {
 public:
  Placement() { ::posix_spawn_file_actions_init(&actions_); }
  ~Placement() { ::posix_spawn_file_actions_destroy(&actions_); }
  Placement(const Placement&) = delete;
  Placement& operator=(const Placement&) = delete;

  void put(int fd, int at) {
    // Out of the way of the places first.
    copies_.emplace_back(::fcntl(fd, F_DUPFD_CLOEXEC, 64));
    if (!copies_.back()) cannot("fcntl", errno);
    ::posix_spawn_file_actions_adddup2(&actions_, copies_.back().get(), at);
  }
  const posix_spawn_file_actions_t* finish() {
    ::posix_spawn_file_actions_addclosefrom_np(&actions_, k_end_fd);
    return &actions_;
  }

 private:
  posix_spawn_file_actions_t actions_{};
  std::vector<OwnedDescriptor> copies_;
};

pid_t spawn(const std::string& program, Placement& placement, std::uint32_t threads) {
  posix_spawnattr_t attributes{};
  ::posix_spawnattr_init(&attributes);
  sigset_t none{}, all{};
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  ::posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSID);
  std::array<std::string, 1> arguments = {"farop-runner"};
  std::array<std::string, 5> variables = {"LANG=C", "PATH=/usr/bin:/bin", "HOME=/",
                                          fmt::format("OPENBLAS_NUM_THREADS={}", threads),
                                          fmt::format("OMP_NUM_THREADS={}", threads)};
  std::array<char*, 2> argv = {arguments[0].data(), nullptr};
  std::array<char*, 6> environment = {variables[0].data(), variables[1].data(), variables[2].data(),
                                      variables[3].data(), variables[4].data(), nullptr};
  pid_t pid = -1;
  const int error =
      ::posix_spawn(&pid, program.c_str(), placement.finish(), &attributes, argv.data(), environment.data());
  ::posix_spawnattr_destroy(&attributes);
  if (error != 0) cannot(program.c_str(), error);
  return pid;
}

/// Fixed-size message of a kind.
template <class Message>
RunnerEvent as(const std::byte* bytes) {
  Message message;
  std::memcpy(static_cast<void*>(&message), bytes, sizeof message);
  return message;
}

}  // namespace

RunnerProcess::RunnerProcess(const Start& start) : cookie_(start.settings.cookie) {
  Pair control = socket_pair(), warden = socket_pair(), out = output_pipe(), err = output_pipe();
  const OwnedDescriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  if (!nothing) cannot("/dev/null", errno);
  const SharedMemory settings = packed_settings(start.settings, start.options);
  {
    Placement placement;
    placement.put(nothing.get(), STDIN_FILENO);
    placement.put(out.theirs.get(), STDOUT_FILENO);
    placement.put(err.theirs.get(), STDERR_FILENO);
    placement.put(control.theirs.get(), k_control_fd);
    placement.put(warden.theirs.get(), k_warden_fd);
    placement.put(start.library->fd(), k_library_fd);
    placement.put(settings.fd(), k_settings_fd);
    placement.put(start.black_box->fd(), k_black_box_fd);
    placement.put(start.ring->fd(), k_ring_fd);
    warden_pid_ = spawn(start.runner, placement, start.settings.threads);
  }
  control_ = std::move(control.ours);
  warden_ = std::move(warden.ours);
  out_pipe_ = std::move(out.ours);
  err_pipe_ = std::move(err.ours);
}

RunnerProcess::~RunnerProcess() {
  try {
    end();
  } catch (const Error&) {  // nobody to tell
  }
}

bool RunnerProcess::send(const Request& request, int memory) {
  iovec part{const_cast<Request*>(&request), sizeof request};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> space{};
  msghdr message{};
  message.msg_iov = &part, message.msg_iovlen = 1;
  if (memory >= 0) {
    message.msg_control = space.data(), message.msg_controllen = space.size();
    cmsghdr* const header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET, header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof memory);
    std::memcpy(CMSG_DATA(header), &memory, sizeof memory);
  }
  for (;;) {
    // There are never more requests on their way than the socket holds.
    const ssize_t sent = ::sendmsg(control_.get(), &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) return true;
    if (errno != EINTR) return false;
  }
}

pid_t RunnerProcess::runner_pid() {
  const auto deadline = Clock::now() + milliseconds(1000);
  while (runner_pid_ < 0 && warden_ && Clock::now() < deadline) poll_once(milliseconds(20));
  return runner_pid_;
}

void RunnerProcess::loaded() {
  const char order = k_loaded;
  if (warden_) ::send(warden_.get(), &order, 1, MSG_NOSIGNAL);
}

double RunnerProcess::cpu_seconds() const {
  if (end_) return static_cast<double>(end_->cpu_nanoseconds) * 1e-9;
  clockid_t clock{};
  timespec used{};
  if (runner_pid_ < 0 || ::clock_getcpuclockid(runner_pid_, &clock) != 0 ||
      ::clock_gettime(clock, &used) != 0) {
    return 0;
  }
  return static_cast<double>(used.tv_sec) + static_cast<double>(used.tv_nsec) * 1e-9;
}

std::optional<std::uint64_t> RunnerProcess::data_bytes() const {
  if (runner_pid_ < 0 || ended_) return std::nullopt;
  const OwnedDescriptor file(
      ::open(fmt::format("/proc/{}/statm", runner_pid_).c_str(), O_RDONLY | O_CLOEXEC));
  std::array<char, 256> text{};
  unsigned long long pages = 0;
  // size resident shared text lib data dirty, in pages
  if (!file || ::read(file.get(), text.data(), text.size() - 1) <= 0 ||
      std::sscanf(text.data(), "%*u %*u %*u %*u %*u %llu", &pages) != 1) {
    return std::nullopt;
  }
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void RunnerProcess::start_clocks(const RunnerLimits& limits) {
  limits_ = limits;
  cpu_start_ = cpu_seconds();
  waited_ = {};
  if (runner_pid_ < 0) return;
  // Should this process be stopped, the kernel ends the runner. A second more than ours: then the words are
  // ours. Not where the runner has become another user and we lack the capability for it.
  rlimit limit{};
  limit.rlim_cur = static_cast<rlim_t>(std::ceil(cpu_start_ + limits.cpu_seconds)) + 1;
  limit.rlim_max = RLIM_INFINITY;
  ::prlimit(runner_pid_, RLIMIT_CPU, &limit, nullptr);
}

std::optional<TimedOut> RunnerProcess::over_limit() {
  if (ended_) return std::nullopt;
  const auto now = Clock::now();
  if (now < next_look_) return std::nullopt;
  next_look_ = now + milliseconds(20);
  if (cpu_seconds() - cpu_start_ > limits_.cpu_seconds) return TimedOut{true, limits_.cpu_seconds};
  if (std::chrono::duration<double>(waited_).count() > limits_.wall_seconds) {
    return TimedOut{false, limits_.wall_seconds};
  }
  return std::nullopt;
}

std::optional<RunnerEvent> RunnerProcess::next(bool wait) {
  bool looked = false;
  for (;;) {
    // The clock first: whoever has something to say without end is stopped all the same.
    if (const auto over = over_limit()) {
      end();
      said_end_ = true;
      return *over;
    }
    if (next_event_ < events_.size()) {
      RunnerEvent event = std::move(events_[next_event_++]);
      if (next_event_ == events_.size()) events_.clear(), next_event_ = 0;
      return event;
    }
    if (trouble_) throw Error(*trouble_);
    if (end_ && !said_end_) {
      said_end_ = true;
      return *end_;
    }
    if (said_end_ || (looked && !wait)) return std::nullopt;
    poll_once(milliseconds(wait ? 50 : 0));
    looked = true;
  }
}

void RunnerProcess::poll_once(milliseconds patience) {
  std::array<pollfd, 4> all{{{control_.get(), POLLIN, 0},
                             {warden_.get(), POLLIN, 0},
                             {out_pipe_.get(), POLLIN, 0},
                             {err_pipe_.get(), POLLIN, 0}}};
  const auto begun = Clock::now();
  const int ready = ::poll(all.data(), all.size(), static_cast<int>(patience.count()));
  if (ready > 0) {
    // Before the warden's news: what the runner said before it ended comes first.
    if (all[2].revents != 0) read_output(out_pipe_, out_);
    if (all[3].revents != 0) read_output(err_pipe_, err_);
    if (all[0].revents != 0) read_control();
    if (all[1].revents != 0) read_warden();
  }
  // A process that was stopped and went on later (or a machine that slept) waited for nobody.
  if (patience.count() > 0) waited_ += std::min<Clock::duration>(Clock::now() - begun, 10 * patience);
}

void RunnerProcess::read_control() {
  constexpr std::size_t most = std::max(sizeof(Loaded), sizeof(LogLine)) + 1;
  std::array<std::byte, most> bytes;
  // A few at a time: whoever talks without end does not keep us from looking at the clock.
  for (int i = 0; i < 16 && control_; ++i) {
    const ssize_t got = ::recv(control_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (got <= 0) return control_.reset();  // closed; the warden will say more
    Reply reply;
    const auto size = static_cast<std::size_t>(got);
    if (size >= sizeof reply) std::memcpy(static_cast<void*>(&reply), bytes.data(), sizeof reply);
    const bool known = size >= sizeof reply && reply.cookie == cookie_;
    if (known && reply.kind == ReplyKind::done && size == sizeof(Reply)) {
      events_.push_back(reply);
    } else if (known && reply.kind == ReplyKind::hello && size == sizeof(Hello)) {
      events_.push_back(as<Hello>(bytes.data()));
    } else if (known && reply.kind == ReplyKind::loaded && size == sizeof(Loaded)) {
      events_.push_back(as<Loaded>(bytes.data()));
    } else if (known && reply.kind == ReplyKind::log && size == sizeof(LogLine)) {
      events_.push_back(as<LogLine>(bytes.data()));
    } else if (known && reply.kind == ReplyKind::finding && size == sizeof(CheckFinding)) {
      events_.push_back(as<CheckFinding>(bytes.data()));
    } else {
      events_.push_back(ProtocolBreach{fmt::format("a message of {} bytes that is none of ours", size)});
      return control_.reset();
    }
  }
}

void RunnerProcess::read_warden() {
  for (;;) {
    WardenMessage message;
    const ssize_t got = ::recv(warden_.get(), static_cast<void*>(&message), sizeof message, MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (got != static_cast<ssize_t>(sizeof message)) {
      if (!end_ && !trouble_) {
        trouble_.emplace(ExitStatus::surroundings, "the rasterizer's process was ended from outside",
                         "did the machine run out of memory?");
      }
      ended_ = true;
      return warden_.reset();
    }
    message.what[sizeof message.what - 1] = '\0';
    switch (message.kind) {
      case WardenKind::started:
        runner_pid_ = message.pid;
        break;
      case WardenKind::refused:
        refusals_.push_back(message);
        break;
      case WardenKind::ended:
        ended_ = true;
        // Its last words; bounded by what sockets and pipes hold.
        for (int i = 0; i < 64 && control_; ++i) read_control();
        for (int i = 0; i < 16; ++i) read_output(out_pipe_, out_), read_output(err_pipe_, err_);
        end_ = RunnerEnded{message.wait_status, message.cpu_nanoseconds, message.peak_bytes};
        break;
      case WardenKind::failed:
        trouble_.emplace(ExitStatus::surroundings, fmt::format("cannot run a rasterizer beside farop: {}: {}",
                                                               message.what, std::strerror(message.error)));
        break;
    }
  }
}

void RunnerProcess::read_output(OwnedDescriptor& pipe, Output& output) {
  std::array<char, 65536> block;
  for (int i = 0; i < 16 && pipe; ++i) {
    const ssize_t got = ::read(pipe.get(), block.data(), block.size());
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (got <= 0) return pipe.reset();
    const auto size = static_cast<std::size_t>(got);
    output.bytes += size;
    output.text.append(block.data(), std::min(size, k_max_output - output.text.size()));
  }
}

RunnerEnded RunnerProcess::end() {
  if (!ended_ && warden_) {
    const char order = k_kill;
    ::send(warden_.get(), &order, 1, MSG_NOSIGNAL);
  }
  // The warden says so when everything is swept up.
  const auto deadline = Clock::now() + milliseconds(3000);
  while (!end_ && warden_ && Clock::now() < deadline) poll_once(milliseconds(20));
  reap();
  return end_.value_or(RunnerEnded{});
}

RunnerEnded RunnerProcess::end_gently() {
  const auto deadline = Clock::now() + milliseconds(200);
  while (!end_ && warden_ && Clock::now() < deadline) poll_once(milliseconds(20));
  return end();
}

void RunnerProcess::reap() {
  if (reaped_) return;
  reaped_ = true;
  ended_ = true;
  const auto deadline = Clock::now() + milliseconds(1000);
  warden_.reset();  // it goes when it sees this, if it is not on its way already
  control_.reset();
  int status = 0;
  for (;;) {
    const pid_t gone = ::waitpid(warden_pid_, &status, WNOHANG);
    if (gone == warden_pid_ || (gone < 0 && errno != EINTR)) break;
    // Its children die with it (PR_SET_PDEATHSIG).
    if (Clock::now() > deadline) ::kill(warden_pid_, SIGKILL);
    const timespec moment{0, 200000};
    ::nanosleep(&moment, nullptr);
  }
  out_pipe_.reset();
  err_pipe_.reset();
}

}  // namespace farop::isolate
