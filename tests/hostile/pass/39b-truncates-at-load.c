// SPDX-License-Identifier: GPL-3.0-or-later
// Does: shrinks every nameless shared memory while it is being loaded.
// Why:  the descriptors are open then; the seals must be there already.
// also: limit.syscall, abi.load
#include "../hostile.h"

__attribute__((constructor)) static void at_load(void) {
  for (int fd = 3; fd < 64; ++fd) {
    if (!hostile_is_memory(fd)) continue;
    hostile_must_fail("ftruncate to nothing", ftruncate(fd, 0));
    hostile_must_fail("ftruncate to 1 GiB", ftruncate(fd, 1 << 30));
  }
}

HOSTILE_PLUGIN()
