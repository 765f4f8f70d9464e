// SPDX-License-Identifier: GPL-3.0-or-later
// Does: recurses without end.
// Why:  the crash handler needs a stack of its own to say so.
#include "../hostile.h"

#pragma GCC diagnostic ignored "-Winfinite-recursion"

__attribute__((noinline)) static int flood_fill(int x) {
  volatile char row[256];
  row[x & 255] = (char)x;
  return flood_fill(x + 1) + row[(x + 1) & 255];  // used after the call: no tail call
}

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  volatile int depth = flood_fill(0);
  (void)depth;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
