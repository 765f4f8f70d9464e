// SPDX-License-Identifier: GPL-3.0-or-later
// Does: closes stdout and stderr.
// Why:  end of file on a pipe is not the end of the run.
// also: limit.syscall
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  close(STDOUT_FILENO);
  close(STDERR_FILENO);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
