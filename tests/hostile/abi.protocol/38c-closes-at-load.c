// SPDX-License-Identifier: GPL-3.0-or-later
// Does: closes every descriptor while it is being loaded.
// Why:  the runner loses its tongue before its first word.
// also: abi.load, limit.syscall, crash.exit
#include "../hostile.h"

__attribute__((constructor)) static void at_load(void) {
  syscall(SYS_close_range, 3, ~0u, 0);
  for (int fd = 3; fd < 1024; ++fd) close(fd);
}

HOSTILE_PLUGIN()
