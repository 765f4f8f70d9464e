// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace farop {

/// Tells the thread sanitizer what oneTBB guarantees and it cannot see, the library not being built with it:
/// what was done before tasks were started is known to all of them, and what they did to who waited for them.
/// Nothing of what tasks do at the same time is hidden. Without the sanitizer it is nothing.
class TaskOrder {
 public:
#ifdef __SANITIZE_THREAD__
  void before_all() {
    __tsan_release(&begun_);
  }
  void begin() {
    __tsan_acquire(&begun_);
  }
  void end() {
    __tsan_release(&ended_);
  }
  void after_all() {
    __tsan_acquire(&ended_);
  }

 private:
  char begun_ = 0, ended_ = 0;
#else
  void before_all() {}
  void begin() {}
  void end() {}
  void after_all() {}
#endif
};

}  // namespace farop
