// SPDX-License-Identifier: GPL-3.0-or-later
// Does: starts 10,000 threads with small stacks that wait; all end at once after 5 s at the latest.
// Why:  threads are processes to the kernel; an allowance of N has to mean N.
// also: limit.syscall
#include <pthread.h>

#include "../hostile.h"

static volatile int released;

static void* wait_for_release(void* nothing) {
  hostile_mark();
  for (int i = 0; i < 500 && !released; ++i) hostile_sleep(0.01);
  return nothing;
}

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, 16 << 10);
  pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
  int started = 0;
  pthread_t thread;
  while (started < 10000 && pthread_create(&thread, &attributes, wait_for_release, NULL) == 0) ++started;
  if (started == 10000) hostile_found("hostile-hole", "10,000 threads", NULL);
  released = 1;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
