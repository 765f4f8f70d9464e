// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/hardware_counters.h"

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace farop {

PerfCounter::PerfCounter(std::uint32_t type, std::uint64_t event) {
  perf_event_attr attributes{};
  attributes.type = type;
  attributes.size = sizeof attributes;
  attributes.config = event;
  attributes.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
  attributes.inherit = 1;
  attributes.exclude_kernel = 1;  // what a user without privileges may count
  attributes.exclude_hv = 1;
  const long opened = ::syscall(SYS_perf_event_open, &attributes, 0, -1, -1, PERF_FLAG_FD_CLOEXEC);
  if (opened < 0) {
    error_ = errno;
  } else {
    descriptor_ = static_cast<int>(opened);
  }
}

PerfCounter::~PerfCounter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::optional<std::uint64_t> PerfCounter::read() const {
  std::array<std::uint64_t, 3> value{};  // count, nanoseconds enabled, nanoseconds on the processor
  if (descriptor_ < 0 || ::read(descriptor_, value.data(), sizeof value) != sizeof value) return std::nullopt;
  if (value[2] == 0) return value[1] == 0 ? std::optional(value[0]) : std::nullopt;
  if (value[1] == value[2]) return value[0];
  return static_cast<std::uint64_t>(static_cast<double>(value[0]) * static_cast<double>(value[1]) /
                                    static_cast<double>(value[2]));
}

HardwareCounters::HardwareCounters()
    : cycles(PERF_TYPE_HARDWARE, PERF_COUNT_HW_CPU_CYCLES),
      instructions(PERF_TYPE_HARDWARE, PERF_COUNT_HW_INSTRUCTIONS) {}

const HardwareCounters& HardwareCounters::of_process() {
  static const HardwareCounters counters;
  return counters;
}

}  // namespace farop
