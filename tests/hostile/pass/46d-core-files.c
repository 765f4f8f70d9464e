// SPDX-License-Identifier: GPL-3.0-or-later
// Does: makes itself dumpable, with cores of any size.
// Why:  a core file would hold the scene, and would be a file.
// also: limit.syscall
#include <sys/resource.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  struct rlimit infinite = {RLIM_INFINITY, RLIM_INFINITY}, old;
  if (getrlimit(RLIMIT_CORE, &old) == 0 && old.rlim_max == 0)
    hostile_must_fail("limit of core size", setrlimit(RLIMIT_CORE, &infinite));
  prctl(PR_SET_DUMPABLE, 1);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
