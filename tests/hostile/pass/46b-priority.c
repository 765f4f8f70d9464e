// SPDX-License-Identifier: GPL-3.0-or-later
// Does: asks for nice -20 and for the real-time scheduler.
// Why:  a real-time loop would starve the judge.
// also: limit.syscall
#include <sched.h>
#include <sys/resource.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  hostile_must_fail("setpriority", setpriority(PRIO_PROCESS, 0, -20));
  struct sched_param highest = {.sched_priority = 1};
  int result = sched_setscheduler(0, SCHED_FIFO, &highest);
  hostile_must_fail("SCHED_FIFO", result);
  highest.sched_priority = 0;
  if (result == 0) sched_setscheduler(0, SCHED_OTHER, &highest);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
