// SPDX-License-Identifier: GPL-3.0-or-later
// Does: ends the calling thread alone with the raw exit call.
// Why:  with a second thread alive the process would stay and never answer.
// also: limit.time
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  syscall(SYS_exit, 0);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
