// SPDX-License-Identifier: GPL-3.0-or-later
// Does: raises its limit of CPU time, then loops.
// Why:  the limit holds all the same: the judge has a clock of its own.
// also: limit.syscall
#include <sys/resource.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  struct rlimit infinite = {RLIM_INFINITY, RLIM_INFINITY}, old;
  if (getrlimit(RLIMIT_CPU, &old) == 0) {
    setrlimit(RLIMIT_CPU, &infinite);
    old.rlim_cur = old.rlim_max;
    setrlimit(RLIMIT_CPU, &old);
  }
  hostile_loop();
}

HOSTILE_PLUGIN(.before = deed)
