// SPDX-License-Identifier: GPL-3.0-or-later
// Does: binds itself to processor 0.
// Why:  would crowd the neighbour who is measured there.
// also: limit.syscall
#define _GNU_SOURCE 1
#include <sched.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  cpu_set_t all, first;
  CPU_ZERO(&first);
  CPU_SET(0, &first);
  if (sched_getaffinity(0, sizeof all, &all) != 0) return FAROP_OK;
  int result = sched_setaffinity(0, sizeof first, &first);
  hostile_must_fail("sched_setaffinity", result);
  if (result == 0) sched_setaffinity(0, sizeof all, &all);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
