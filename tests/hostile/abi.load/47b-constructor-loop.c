// SPDX-License-Identifier: GPL-3.0-or-later
// Does: loops while it is being loaded.
// Why:  the clock has to run before the first case.
// also: limit.time
#include "../hostile.h"

__attribute__((constructor)) static void at_load(void) {
  hostile_loop();
}

HOSTILE_PLUGIN()
