// SPDX-License-Identifier: GPL-3.0-or-later
// Does: shrinks and grows every nameless shared memory it holds.
// Why:  unsealed, the judge would die of SIGBUS when it reads the frame.
// also: limit.syscall
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (int fd = 3; fd < 64; ++fd) {
    if (!hostile_is_memory(fd)) continue;
    hostile_must_fail("ftruncate to nothing", ftruncate(fd, 0));
    hostile_must_fail("ftruncate to 1 GiB", ftruncate(fd, 1 << 30));
  }
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
