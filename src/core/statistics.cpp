// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/statistics.h"

#include <sys/resource.h>

namespace farop {
namespace {

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

StageTime now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return {std::chrono::duration<double>(since_start).count(), seconds(usage.ru_utime),
          seconds(usage.ru_stime)};
}

}  // namespace

void StageTimer::start() {
  begun_ = now();
  ran_ = true;
}

void StageTimer::stop() {
  const StageTime end = now();
  total_ += {end.elapsed - begun_.elapsed, end.user - begun_.user, end.system - begun_.system};
  if (log_ != nullptr) log_->add({stage_, begun_.elapsed, end.elapsed});
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts kilobytes
}

}  // namespace farop
