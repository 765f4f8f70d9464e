// SPDX-License-Identifier: GPL-3.0-or-later
// Does: leaves a thread behind that scribbles over the frame for 2 s after end_frame().
// Why:  the judge must copy the frame before it looks, and must not hand the memory to the next case.
// also: oob.write-after-end, oob.write-after, frame.background, crash.segv, limit.threads, limit.syscall
// needs: two frames in one process, threads allowed
#include <pthread.h>

#include "../hostile.h"

static uint8_t* volatile target;
static volatile size_t target_bytes;

static void* scribble(void* nothing) {
  hostile_mark();
  for (int i = 0; i < 2000; ++i) {
    hostile_sleep(0.001);
    for (size_t at = 0; at < target_bytes; at += 97) ((volatile uint8_t*)target)[at] = (uint8_t)i;
  }
  return nothing;
}
static farop_status end(void) {
  static int started;
  pthread_t thread;
  if (started || hostile.polygons == 0) return FAROP_OK;
  started = 1;
  target = hostile.frame.pixels;
  target_bytes = (size_t)(hostile.frame.row_bytes * hostile.frame.height);
  if (pthread_create(&thread, NULL, scribble, NULL) == 0) pthread_detach(thread);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.end = end)
