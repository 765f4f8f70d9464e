// SPDX-License-Identifier: GPL-3.0-or-later
// SIGTERM and SIGINT as a wish to come to an end, for work that can stop half-way and still report.
#pragma once

#include <csignal>

namespace farop::app {

/// While one lives, the first SIGTERM or SIGINT is noted; a second one ends the program as ever. One at a
/// time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  static bool came();

 private:
  struct sigaction term_ {
  }, interrupt_{};
};

}  // namespace farop::app
