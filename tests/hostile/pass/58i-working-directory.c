// SPDX-License-Identifier: GPL-3.0-or-later
// Does: changes the working directory, the file mask and the process name.
// Why:  nothing of the runner may depend on them.
// also: limit.syscall
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  if (chdir("/") != 0) errno = 0;
  umask(0777);
  hostile_mark();
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
