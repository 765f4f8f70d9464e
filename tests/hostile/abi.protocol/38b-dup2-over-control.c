// SPDX-License-Identifier: GPL-3.0-or-later
// Does: puts /dev/null, or its stdin, in the place of descriptors 3 to 15.
// Why:  the runner would talk to nobody and wait for ever.
// also: limit.syscall, limit.time, crash.exit, pass
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (int fd = 3; fd < 16; ++fd)
    if (hostile_is_control(fd)) dup2(STDIN_FILENO, fd);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
