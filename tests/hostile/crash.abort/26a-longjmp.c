// SPDX-License-Identifier: GPL-3.0-or-later
// Does: jumps from polygon() back into begin_frame(), which has returned.
// Why:  libc notices the dead frame and aborts; nothing may pass for a picture.
// also: crash.exit, crash.segv
#undef _FORTIFY_SOURCE
#define _FORTIFY_SOURCE 2
#define _GNU_SOURCE 1
#include <setjmp.h>

#include "../hostile.h"

static jmp_buf home;

// Deeper in the stack than polygon() will be called: then the jump is sure to lead into a dead frame.
__attribute__((noinline)) static int remember(int depth) {
  volatile char room[1024];
  room[depth & 1023] = (char)depth;
  if (depth > 0) return remember(depth - 1) + room[depth & 1023];
  return setjmp(home);
}
static farop_status begin(const farop_frame* frame) {
  (void)frame;
  volatile int came_back = remember(32);
  (void)came_back;
  return FAROP_OK;
}
static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  longjmp(home, 1);
}

HOSTILE_PLUGIN(.begin = begin, .before = deed)
