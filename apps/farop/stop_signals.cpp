// SPDX-License-Identifier: GPL-3.0-or-later
#include "stop_signals.h"

#include <atomic>

namespace farop::app {
namespace {

std::atomic<bool> g_came{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void note_signal(int) {
  g_came = true;
}

}  // namespace

StopSignals::StopSignals() {
  g_came = false;
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  ::sigaction(SIGTERM, &action, &term_);
  ::sigaction(SIGINT, &action, &interrupt_);
}

StopSignals::~StopSignals() {
  ::sigaction(SIGTERM, &term_, nullptr);
  ::sigaction(SIGINT, &interrupt_, nullptr);
}

bool StopSignals::came() {
  return g_came;
}

}  // namespace farop::app
