// SPDX-License-Identifier: GPL-3.0-or-later
// Does: calls pthread_exit() on the thread that it was called on.
// Why:  the process would end with status 0, or hang with its threads.
// also: crash.abort, limit.time
#include <pthread.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  pthread_exit(NULL);
}

HOSTILE_PLUGIN(.before = deed)
