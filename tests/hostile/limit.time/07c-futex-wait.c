// SPDX-License-Identifier: GPL-3.0-or-later
// Does: waits on a futex that nobody wakes.
// Why:  a deadlock: futex is a call that the filter allows.
#include <linux/futex.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  struct timespec longest = {HOSTILE_LONGEST_SECONDS, 0};
  static int locked = 1;
  for (int i = 0; i < 2; ++i) syscall(SYS_futex, &locked, FUTEX_WAIT_PRIVATE, 1, &longest, NULL, 0);
  _exit(1);
}

HOSTILE_PLUGIN(.before = deed)
