// SPDX-License-Identifier: GPL-3.0-or-later
// Does: counts its own instructions with perf_event_open.
// Why:  a large interface with a long list of holes.
// also: crash.sigsys, pass
#include <linux/perf_event.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  struct perf_event_attr event;
  memset(&event, 0, sizeof event);
  event.size = sizeof event;
  event.type = PERF_TYPE_SOFTWARE;
  event.config = PERF_COUNT_SW_TASK_CLOCK;
  event.exclude_kernel = 1;
  int fd = (int)syscall(SYS_perf_event_open, &event, 0, -1, -1, 0ul);
  hostile_must_fail("perf_event_open", fd);
  if (fd >= 0) close(fd);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
