// SPDX-License-Identifier: GPL-3.0-or-later
// Does: draws the two halves of every polygon's colours in two threads that do not wait for each other.
// Why:  a race shows in the picture now and then only; runs are compared bit by bit.
// also: det.rerun, det.fill, colour.wrong, limit.threads, limit.syscall, abi.status
// needs: threads allowed
#include <pthread.h>

#include "../hostile.h"

// Both threads count in one variable; the lost updates, different each time, go into the colours.
static volatile unsigned counter;

static void* count(void* nothing) {
  for (int i = 0; i < 200000; ++i) counter = counter + 1;
  return nothing;
}
static farop_status each(const farop_polygon* polygon) {
  (void)polygon;
  pthread_t thread;
  if (pthread_create(&thread, NULL, count, NULL) != 0) return FAROP_E_INTERNAL;
  count(NULL);
  pthread_join(thread, NULL);
  return FAROP_OK;
}
static int pixel(int32_t x, int32_t y, uint8_t* rgb) {
  (void)x, (void)y;
  for (int i = 0; i < 3; ++i) rgb[i] = (uint8_t)(rgb[i] ^ counter);
  return 1;
}

HOSTILE_PLUGIN(.each = each, .pixel = pixel)
