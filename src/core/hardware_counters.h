// SPDX-License-Identifier: GPL-3.0-or-later
// Counters of the processor, where the machine lets us count.
#pragma once

#include <cstdint>
#include <optional>

namespace farop {

/// An event of perf_event_open(2), counted in user mode for the thread that makes this and for all threads
/// which it starts afterwards, from now on. Where the kernel refuses, read() has no value.
class PerfCounter {
 public:
  /// `type` and `event` as perf_event_attr has them: PERF_TYPE_HARDWARE, PERF_COUNT_HW_CPU_CYCLES ...
  PerfCounter(std::uint32_t type, std::uint64_t event);
  ~PerfCounter();
  PerfCounter(const PerfCounter&) = delete;
  PerfCounter& operator=(const PerfCounter&) = delete;

  /// errno of the refusal; 0: it counts.
  int error() const { return error_; }
  /// Events so far, estimated where the processor had too few counters for all who asked.
  std::optional<std::uint64_t> read() const;

 private:
  int descriptor_ = -1;
  int error_ = 0;
};

struct HardwareCounters {
  PerfCounter cycles, instructions;

  HardwareCounters();
  /// Those of this process. The first call opens them: early, in the main thread, before any filter of system
  /// calls.
  static const HardwareCounters& of_process();
};

}  // namespace farop
