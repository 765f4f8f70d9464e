// SPDX-License-Identifier: GPL-3.0-or-later
// The process that a rasterizer runs in, as seen from outside: started, spoken to, watched, ended.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "isolate/isolation.h"
#include "isolate/protocol.h"
#include "isolate/shared_memory.h"

namespace farop::isolate {

/// Something the runner said that it must not say; or nothing was understood.
struct ProtocolBreach {
  std::string what;
};
/// The runner is gone.
struct RunnerEnded {
  int wait_status = 0;
  std::uint64_t cpu_nanoseconds = 0, peak_bytes = 0;
};
/// It took too long and was killed.
struct TimedOut {
  bool cpu = false;  ///< else wall clock
  double seconds = 0;
};
using RunnerEvent =
    std::variant<Reply, Hello, Loaded, LogLine, CheckFinding, ProtocolBreach, RunnerEnded, TimedOut>;

/// First 64 KiB of what a process printed.
struct Output {
  std::string text;
  std::uint64_t bytes = 0;  ///< all of it
};
constexpr std::size_t k_max_output = std::size_t{64} << 10;

/// Warden and runner. Reads whatever they say, at once and in order; believes the warden only.
/// Throws Error(ExitStatus::surroundings) for what the machine cannot do.
class RunnerProcess {
 public:
  struct Start {
    std::string runner;
    const SharedMemory* library = nullptr;
    const SharedMemory* black_box = nullptr;
    const SharedMemory* ring = nullptr;
    Settings settings;  ///< options_bytes is filled in here
    const std::map<std::string, std::string>* options = nullptr;
  };
  explicit RunnerProcess(const Start& start);
  ~RunnerProcess();  ///< kills what still runs and waits for it
  RunnerProcess(const RunnerProcess&) = delete;
  RunnerProcess& operator=(const RunnerProcess&) = delete;

  /// False: it does not listen any more; next() will say why.
  bool send(const Request& request, int memory = -1);
  /// Tells the warden that no more code may be mapped.
  void loaded();

  /// Restarts the clocks of `limits`.
  void start_clocks(const RunnerLimits& limits);
  /// The next thing that happens; nothing when `wait` is false and nothing has happened.
  std::optional<RunnerEvent> next(bool wait);
  /// Kills it, and comes back when nothing of it is left.
  RunnerEnded end();
  /// After a quit: as end(), but gives it 200 ms to go by itself.
  RunnerEnded end_gently();

  bool is_alive() const { return !ended_; }
  /// As this process sees it. Waits for the warden to tell, a second at most; then -1.
  pid_t runner_pid();
  /// Refused system calls, a kind at a time, since the last call of this.
  std::vector<WardenMessage> take_refusals() { return std::exchange(refusals_, {}); }
  const Output& out() const { return out_; }
  const Output& err() const { return err_; }
  /// CPU seconds of the runner so far.
  double cpu_seconds() const;
  /// Its private writable memory, where the system tells.
  std::optional<std::uint64_t> data_bytes() const;

 private:
  using Clock = std::chrono::steady_clock;

  void poll_once(std::chrono::milliseconds patience);
  void read_control();
  void read_warden();
  void read_output(OwnedDescriptor& pipe, Output& output);
  std::optional<TimedOut> over_limit();
  void reap();

  OwnedDescriptor control_, warden_, out_pipe_, err_pipe_;
  pid_t warden_pid_ = -1;
  pid_t runner_pid_ = -1;
  std::uint64_t cookie_ = 0;
  bool ended_ = false;     ///< the runner
  bool reaped_ = false;    ///< the warden
  bool said_end_ = false;  ///< next() has delivered it
  std::optional<RunnerEnded> end_;
  std::optional<Error> trouble_;
  std::vector<RunnerEvent> events_;
  std::size_t next_event_ = 0;
  std::vector<WardenMessage> refusals_;
  Output out_, err_;
  RunnerLimits limits_;
  double cpu_start_ = 0;
  Clock::duration waited_{};
  Clock::time_point next_look_;  ///< at the clocks
};

}  // namespace farop::isolate
