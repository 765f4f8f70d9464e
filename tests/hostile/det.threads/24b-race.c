// SPDX-License-Identifier: GPL-3.0-or-later
// Does: computes every polygon's colours in two threads that do not wait for each other.
// Why:  a race shows in the picture now and then only; runs are compared bit by bit.
// also: det.rerun, det.fill, colour.wrong, limit.threads, limit.syscall, abi.status
// needs: threads allowed
#include <pthread.h>
#include <sched.h>

#include "../hostile.h"

// Both threads count in one variable, the other one until it is told to stop: how far they get, which goes
// into the colours, is another number each time, even where they take turns on one processor.
static volatile unsigned counter;
static volatile int started, stop;

static void* count(void* nothing) {
  started = 1;
  while (!stop) counter = counter + 1;
  return nothing;
}
static farop_status each(const farop_polygon* polygon) {
  (void)polygon;
  pthread_t thread;
  started = stop = 0;
  if (pthread_create(&thread, NULL, count, NULL) != 0) return FAROP_E_INTERNAL;
  for (double end = hostile_now() + 5; !started && hostile_now() < end;) sched_yield();
  for (int i = 0; i < 2000; ++i) counter = counter + 1;
  stop = 1;
  pthread_join(thread, NULL);
  return FAROP_OK;
}
static int pixel(int32_t x, int32_t y, uint8_t* rgb) {
  (void)x, (void)y;
  for (int i = 0; i < 3; ++i) rgb[i] = (uint8_t)(rgb[i] ^ counter);
  return 1;
}

HOSTILE_PLUGIN(.each = each, .pixel = pixel)
