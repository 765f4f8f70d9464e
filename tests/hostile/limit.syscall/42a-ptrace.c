// SPDX-License-Identifier: GPL-3.0-or-later
// Does: attaches to the judge as a debugger.
// Why:  a debugger owns the process: every verdict would be its to write.
// also: crash.sigsys
#include <sys/ptrace.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  pid_t judge = hostile_judge();
  // SEIZE does not stop the judge if the wall is missing. With nobody to aim at: a call that cannot succeed.
  long result = ptrace(PTRACE_SEIZE, judge > 0 ? judge : getpid(), NULL, NULL);
  hostile_must_fail("ptrace", result);
  if (result == 0) ptrace(PTRACE_DETACH, judge, NULL, NULL);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
