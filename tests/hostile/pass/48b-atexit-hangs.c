// SPDX-License-Identifier: GPL-3.0-or-later
// Does: hangs in an atexit handler.
// Why:  all pictures are in: the runner is given 200 ms, then killed.
#include "../hostile.h"

static void at_exit(void) {
  for (int i = 0; i < HOSTILE_LONGEST_SECONDS; ++i) hostile_sleep(1);
}

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  atexit(at_exit);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
