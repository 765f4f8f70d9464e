// SPDX-License-Identifier: GPL-3.0-or-later
// Does: closes every descriptor.
// Why:  the runner cannot answer any more; that is the plug-in's doing.
// also: limit.syscall, crash.exit, pass
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  syscall(SYS_close_range, 0, ~0u, 0);
  for (int fd = 0; fd < 1024; ++fd) close(fd);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
