// SPDX-License-Identifier: GPL-3.0-or-later
// Does: hangs in a destructor.
// Why:  all pictures are in: the runner is given 200 ms, then killed.
#include "../hostile.h"

__attribute__((destructor)) static void at_load(void) {
  for (int i = 0; i < HOSTILE_LONGEST_SECONDS; ++i) hostile_sleep(1);
}

HOSTILE_PLUGIN()
