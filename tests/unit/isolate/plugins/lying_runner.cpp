// SPDX-License-Identifier: GPL-3.0-or-later
// In the place of farop-runner: knows the cookie and says what comes to its mind. The option "seed" decides;
// or "script", in hexadecimal, says it byte by byte (tests/fuzz/runner_fuzz.cpp).
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "isolate/protocol.h"

namespace {

using namespace farop::isolate;

std::mt19937_64 g_random;

std::uint64_t any() {
  constexpr std::uint64_t special[] = {0, 1, 2, 3, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, ~std::uint64_t{0}};
  return g_random() % 3 != 0 ? special[g_random() % 8] : g_random();
}

bool one_in(std::uint64_t n) {
  return g_random() % n == 0;
}

template <class Message>
void send_message(int fd, const Message& message) {
  std::size_t bytes = sizeof message;
  if (one_in(40)) bytes = g_random() % (sizeof message + 1);
  if (::send(fd, &message, bytes, MSG_NOSIGNAL) < 0) std::_Exit(0);
}

Reply any_reply(ReplyKind kind, std::uint64_t cookie, std::uint32_t serial) {
  Reply r;
  r.kind = one_in(30) ? static_cast<ReplyKind>(any()) : kind;
  r.cookie = one_in(50) ? any() : cookie;
  r.serial = one_in(20) ? static_cast<std::uint32_t>(any()) : serial;
  r.status = one_in(10) ? static_cast<std::int32_t>(any()) : 0;
  r.polygon = static_cast<std::uint32_t>(any());
  r.begun = any(), r.nanoseconds = any(), r.user_nanoseconds = any(), r.system_nanoseconds = any();
  r.cycles = any(), r.instructions = any();
  r.warnings = static_cast<std::uint32_t>(any());
  r.memory_refused = static_cast<std::uint32_t>(any());
  return r;
}

/// No terminating NUL, mostly.
void scribble(char* text, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>(g_random() % 256);
}

void lie();

}  // namespace

/// An honest warden, as only the rasterizer's process can be taken over.
int main() {
  const pid_t runner = ::fork();
  if (runner == 0) {
    ::close(k_warden_fd);
    lie();
    return 0;
  }
  for (int fd = 0; fd <= k_control_fd; ++fd) ::close(fd);
  WardenMessage started;
  started.kind = WardenKind::started;
  started.pid = runner;
  ::send(k_warden_fd, &started, sizeof started, MSG_NOSIGNAL);
  int status = 0;
  while (::waitpid(runner, &status, WNOHANG) == 0) {
    pollfd order{k_warden_fd, POLLIN, 0};
    char byte = 0;
    if (::poll(&order, 1, 2) <= 0) continue;
    if (::recv(k_warden_fd, &byte, 1, 0) <= 0 || byte == k_kill) ::kill(runner, SIGKILL);
  }
  WardenMessage ended;
  ended.kind = WardenKind::ended;
  ended.wait_status = status;
  ::send(k_warden_fd, &ended, sizeof ended, MSG_NOSIGNAL);
  return 0;
}

namespace {

/// A script is a list of steps: a byte that says what, a byte that says where, a byte that says how many
/// bytes follow, and these. Messages are right but for the bytes that are written over them, 8 `where` from
/// their start; answers wait for their question.
class Replay {
 public:
  Replay(std::uint64_t cookie, unsigned char* black_box, const char* hexadecimal)
      : cookie_(cookie), black_box_(black_box) {
    for (const char* at = hexadecimal; at[0] != '\0' && at[1] != '\0'; at += 2) {
      script_.push_back(static_cast<unsigned char>(std::stoi(std::string(at, 2), nullptr, 16)));
    }
  }

  void run() {
    while (at_ + 3 <= script_.size()) {
      const unsigned what = script_[at_], where = script_[at_ + 1];
      const std::size_t count = std::min<std::size_t>(script_[at_ + 2], script_.size() - at_ - 3);
      const unsigned char* const bytes = script_.data() + at_ + 3;
      at_ += 3 + count;
      switch (what % 8) {
        case 0:
          say(Hello{}, ReplyKind::hello, where, bytes, count);
          break;
        case 1:
          answer(Loaded{}, ReplyKind::loaded, where, bytes, count);
          break;
        case 2:
          answer(Reply{}, ReplyKind::done, where, bytes, count);
          break;
        case 3:
          say(LogLine{}, ReplyKind::log, where, bytes, count);
          break;
        case 4:
          say(CheckFinding{}, ReplyKind::finding, where, bytes, count);
          break;
        case 5:
          ::send(k_control_fd, bytes, count, MSG_NOSIGNAL);
          break;
        case 6:
          std::memcpy(black_box_ + 8 * where, bytes, std::min(count, k_black_box_bytes - 8 * where));
          break;
        case 7:
          ::raise(static_cast<int>(where % 32));
          break;
      }
    }
  }

 private:
  template <class Message>
  void say(Message message, ReplyKind kind, std::size_t where, const unsigned char* bytes,
           std::size_t count) {
    Reply reply;
    reply.kind = kind, reply.cookie = cookie_, reply.serial = serial_;
    std::memcpy(static_cast<void*>(&message), &reply, sizeof reply);
    const std::size_t from = std::min(8 * where, sizeof message);
    std::memcpy(reinterpret_cast<unsigned char*>(&message) + from, bytes,
                std::min(count, sizeof message - from));
    ::send(k_control_fd, &message, sizeof message, MSG_NOSIGNAL);
  }

  /// Once it is asked.
  template <class Message>
  void answer(const Message& message, ReplyKind kind, std::size_t where, const unsigned char* bytes,
              std::size_t count) {
    Request request;
    if (::recv(k_control_fd, &request, sizeof request, 0) <= 0) std::_Exit(0);
    serial_ = request.serial;
    say(message, kind, where, bytes, count);
  }

  std::uint64_t cookie_;
  unsigned char* black_box_;
  std::vector<unsigned char> script_;
  std::size_t at_ = 0;
  std::uint32_t serial_ = 0;
};

void lie() {
  struct stat status {};
  ::fstat(k_settings_fd, &status);
  const auto bytes = static_cast<std::size_t>(status.st_size);
  const char* const memory =
      static_cast<const char*>(::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, k_settings_fd, 0));
  Settings settings;
  std::memcpy(&settings, memory, sizeof settings);
  const char* const option = memory + sizeof settings;
  const char* const value = option + std::strlen(option) + 1;
  // The black box is the rasterizer's to write, too.
  void* const box = ::mmap(nullptr, k_black_box_bytes, PROT_READ | PROT_WRITE, MAP_SHARED, k_black_box_fd, 0);
  if (std::strcmp(option, "script") == 0) {
    return Replay(settings.cookie, static_cast<unsigned char*>(box), value).run();
  }
  g_random.seed(static_cast<std::uint64_t>(std::atoll(value)));

  for (std::size_t i = 0; i < k_black_box_bytes; ++i) static_cast<unsigned char*>(box)[i] = g_random() % 8;
  if (one_in(2)) *static_cast<std::uint32_t*>(box) = static_cast<std::uint32_t>(g_random() % 5);

  Hello hello;
  hello.reply = any_reply(ReplyKind::hello, settings.cookie, 0);
  hello.layers = static_cast<std::uint32_t>(any());
  for (std::int32_t& error : hello.error) error = static_cast<std::int32_t>(any());
  send_message(k_control_fd, hello);
  for (int i = 0; i < 60; ++i) {
    Request request;
    const ssize_t got = ::recv(k_control_fd, &request, sizeof request, one_in(4) ? MSG_DONTWAIT : 0);
    if (got == 0) return;
    if (request.kind == RequestKind::load) {
      Loaded loaded;
      loaded.reply = any_reply(ReplyKind::loaded, settings.cookie, request.serial);
      if (!one_in(4)) loaded.reply.status = 0;
      loaded.wants = static_cast<std::uint32_t>(any());
      loaded.abi_version = static_cast<std::uint32_t>(any());
      scribble(loaded.name, sizeof loaded.name);
      scribble(loaded.summary, sizeof loaded.summary);
      scribble(loaded.message, sizeof loaded.message);
      scribble(loaded.hint, sizeof loaded.hint);
      scribble(loaded.warning, sizeof loaded.warning);
      send_message(k_control_fd, loaded);
    } else {
      send_message(k_control_fd, any_reply(ReplyKind::done, settings.cookie, request.serial));
    }
    if (one_in(10)) {
      LogLine line;
      line.reply = any_reply(ReplyKind::log, settings.cookie, 0);
      line.length = static_cast<std::uint32_t>(any());
      scribble(line.text, sizeof line.text);
      send_message(k_control_fd, line);
    }
    if (one_in(25)) {
      CheckFinding finding;
      finding.reply = any_reply(ReplyKind::finding, settings.cookie, 0);
      finding.of_host = static_cast<std::uint32_t>(any());
      finding.has_polygon = static_cast<std::uint32_t>(any());
      scribble(finding.verdict, sizeof finding.verdict);
      scribble(finding.message, sizeof finding.message);
      send_message(k_control_fd, finding);
    }
    if (one_in(60)) break;
  }
  if (one_in(2)) std::_Exit(static_cast<int>(g_random() % 256));
  ::signal(SIGABRT, SIG_DFL);
  if (one_in(2)) ::raise(static_cast<int>(g_random() % 32));
}

}  // namespace
