// SPDX-License-Identifier: GPL-3.0-or-later
// Does: sends SIGTERM to the judge.
// Why:  a dead judge writes no results; a stopped one marks nothing.
#include <signal.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  pid_t judge = hostile_judge();
  // With nobody to aim at, signal 0 to itself: the same call, refused the same way.
  hostile_must_fail("kill", judge > 0 ? kill(judge, SIGTERM) : kill(getpid(), 0));
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
