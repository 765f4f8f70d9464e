// SPDX-License-Identifier: GPL-3.0-or-later
// Does: punches a hole into every nameless shared memory it holds.
// Why:  pages vanish under the judge and come back as zeros; no signal may reach it.
// also: limit.syscall, frame.blank, frame.background, cov.missing, oob.write-after, oob.write-before
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (int fd = 3; fd < 64; ++fd)
    if (hostile_is_memory(fd))
      hostile_must_fail("fallocate", fallocate(fd, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, 0, 1 << 20));
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
