// SPDX-License-Identifier: GPL-3.0-or-later
// Does: writes through a null pointer while it is being loaded.
// Why:  code of the plug-in runs before any call: the same walls, the same report.
// also: crash.segv
#include "../hostile.h"

__attribute__((constructor)) static void at_load(void) {
  hostile_crash();
}

HOSTILE_PLUGIN()
