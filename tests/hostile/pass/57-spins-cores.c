// SPDX-License-Identifier: GPL-3.0-or-later
// Does: keeps all processors busy for 0.3 s before end_frame() returns, once.
// Why:  its own CPU time counts in sum; a neighbour's measurement of that moment is marked as disturbed.
// also: limit.time, limit.threads, limit.syscall
// needs: threads allowed
#include <pthread.h>

#include "../hostile.h"

static void* spin(void* nothing) {
  hostile_mark();
  hostile_spin(0.3);
  return nothing;
}
static farop_status end(void) {
  static int spun;
  if (spun || hostile.polygons == 0) return FAROP_OK;
  spun = 1;
  pthread_t threads[64];
  long count = sysconf(_SC_NPROCESSORS_ONLN);
  if (count > 64) count = 64;
  int started = 0;
  while (started < count - 1 && pthread_create(&threads[started], NULL, spin, NULL) == 0) ++started;
  hostile_spin(0.3);
  while (started > 0) pthread_join(threads[--started], NULL);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.end = end)
