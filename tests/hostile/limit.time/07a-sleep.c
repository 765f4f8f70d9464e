// SPDX-License-Identifier: GPL-3.0-or-later
// Does: sleeps for ever.
// Why:  uses no CPU time: only the wall clock ends it.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (int i = 0; i < HOSTILE_LONGEST_SECONDS; ++i) hostile_sleep(1);
  _exit(1);
}

HOSTILE_PLUGIN(.before = deed)
