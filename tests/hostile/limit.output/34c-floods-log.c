// SPDX-License-Identifier: GPL-3.0-or-later
// Does: logs 100,000 lines of 1 KiB.
// Why:  the third way out, through the host's own call.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  char line[1024];
  memset(line, 'x', sizeof line);
  line[sizeof line - 1] = 0;
  for (int i = 0; i < 100000; ++i) hostile.host->log(hostile.host, FAROP_LOG_WARNING, line);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
