// SPDX-License-Identifier: GPL-3.0-or-later
// Does: has an indirect function whose resolver loops.
// Why:  resolvers run while the library is being relocated, before any constructor.
// also: limit.time
#include "../hostile.h"

typedef int chosen(void);
static int plain(void) {
  return 0;
}
__attribute__((used)) static chosen* resolve(void) {
  for (volatile unsigned long i = 0; i < 1ul << 38; ++i) {  // minutes; no call may be made from here
  }
  return plain;
}
__attribute__((visibility("default"), ifunc("resolve"))) int farop_hostile_choose(void);

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  volatile int n = farop_hostile_choose();
  (void)n;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
