// SPDX-License-Identifier: GPL-3.0-or-later
// Does: fails an assertion.
// Why:  its message on stderr is the most useful thing to show the student.
#undef NDEBUG
#include <assert.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  volatile int edges = 1;
  assert(edges > 1 && "an active edge table holds pairs");
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
