// SPDX-License-Identifier: GPL-3.0-or-later
// A child process for work that may run wild: it is stopped when it takes too long or too much memory, and
// when it crashes only itself is gone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

namespace farop::sipp {

/// The way from the child to its parent. Buffers; throws std::runtime_error when nobody listens any more.
class ChildOutput {
 public:
  explicit ChildOutput(int descriptor) : descriptor_(descriptor) {}
  void write(const void* data, std::size_t size);
  void flush();
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
  std::string buffer_;
};

/// Why a child is gone although it had more to say.
struct ChildLost : std::runtime_error {
  enum class Reason { too_long, too_much_memory, crashed };
  ChildLost(Reason why, const std::string& what) : std::runtime_error(what), reason(why) {}
  Reason reason;
};

class ScriptProcess {
 public:
  /// Starts a child that runs `work` and ends; nothing of it comes back but what it writes. The child's
  /// standard streams are closed, it makes no core file, no files and no processes of its own, and dies with
  /// its parent. Its memory may grow by `memory_mb` beyond what it starts with.
  /// Throws Error(ExitStatus::surroundings) when no process can be started.
  ScriptProcess(const std::function<void(ChildOutput&)>& work, double seconds, std::uint64_t memory_mb);
  /// Stops the child if it still runs.
  ~ScriptProcess();
  ScriptProcess(const ScriptProcess&) = delete;
  ScriptProcess& operator=(const ScriptProcess&) = delete;

  /// Waits for the next bytes of the child. Throws ChildLost when it ends before or must be stopped.
  void read(void* data, std::size_t size);
  /// From now on the child may take its time (it still must not hang: some progress every ten seconds).
  void stop_clock() { clock_runs_ = false; }

 private:
  void fill();
  void watch_memory();
  [[noreturn]] void lost();
  void kill();

  int descriptor_ = -1;
  int child_ = -1;
  double deadline_ = 0;
  bool clock_runs_ = true;
  std::uint64_t memory_mb_;
  std::uint64_t memory_at_start_ = 0, memory_limit_;  ///< resident bytes of its own
  std::string buffer_;
  std::size_t position_ = 0;
};

}  // namespace farop::sipp
