// SPDX-License-Identifier: GPL-3.0-or-later
// Does: prints while it is being loaded.
// Why:  unwise, not wrong: shown, and the run goes on.
#include "../hostile.h"

__attribute__((constructor)) static void at_load(void) {
  dprintf(STDOUT_FILENO, "loading\n");
  dprintf(STDERR_FILENO, "done 0\n");
}

HOSTILE_PLUGIN()
