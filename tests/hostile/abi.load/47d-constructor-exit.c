// SPDX-License-Identifier: GPL-3.0-or-later
// Does: calls exit(0) while it is being loaded.
// Why:  exit status 0 is not a pass.
// also: crash.exit
#include "../hostile.h"

__attribute__((constructor)) static void at_load(void) {
  exit(0);
}

HOSTILE_PLUGIN()
