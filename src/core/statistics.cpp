// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/statistics.h"

#include <sys/resource.h>

#include "core/hardware_counters.h"

namespace farop {
namespace {

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

using Count = std::optional<std::uint64_t>;

void add(Count& sum, const Count& more) {
  if (more) sum = sum.value_or(0) + *more;
}

/// Estimates may run backwards.
Count difference(const Count& begin, const Count& end) {
  if (!begin || !end) return std::nullopt;
  return *end > *begin ? *end - *begin : 0;
}

}  // namespace

StageTime& StageTime::operator+=(const StageTime& o) {
  elapsed += o.elapsed, user += o.user, system += o.system;
  add(cycles, o.cycles), add(instructions, o.instructions);
  return *this;
}

StageTime read_clocks() {
  const HardwareCounters& counters = HardwareCounters::of_process();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return {std::chrono::duration<double>(since_start).count(), seconds(usage.ru_utime),
          seconds(usage.ru_stime), counters.cycles.read(), counters.instructions.read()};
}

StageTime time_between(const StageTime& begin, const StageTime& end) {
  return {end.elapsed - begin.elapsed, end.user - begin.user, end.system - begin.system,
          difference(begin.cycles, end.cycles), difference(begin.instructions, end.instructions)};
}

void StageTimer::start() {
  begun_ = read_clocks();
  ran_ = true;
}

void StageTimer::stop() {
  const StageTime end = read_clocks();
  total_ += time_between(begun_, end);
  if (log_ != nullptr) log_->add({stage_, begun_.elapsed, end.elapsed, track_});
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts kilobytes
}

}  // namespace farop
