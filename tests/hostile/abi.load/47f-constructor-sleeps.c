// SPDX-License-Identifier: GPL-3.0-or-later
// Does: sleeps for ever while it is being loaded.
// Why:  the wall clock has to run, too.
// also: limit.time
#include "../hostile.h"

__attribute__((constructor)) static void at_load(void) {
  for (int i = 0; i < HOSTILE_LONGEST_SECONDS; ++i) hostile_sleep(1);
  _exit(1);
}

HOSTILE_PLUGIN()
