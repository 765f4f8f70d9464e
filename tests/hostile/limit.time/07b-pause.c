// SPDX-License-Identifier: GPL-3.0-or-later
// Does: waits for a signal that never comes; loops where pause() is refused.
// Why:  as sleeping, by another call.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (double end = hostile_now() + HOSTILE_LONGEST_SECONDS; hostile_now() < end;) {
    alarm(HOSTILE_LONGEST_SECONDS);  // bounds the wait
    pause();
  }
  _exit(1);
}

HOSTILE_PLUGIN(.before = deed)
