// SPDX-License-Identifier: GPL-3.0-or-later
// Does: reads one vertex beyond the count.
// Why:  the loop that ends with <=; the picture may well be right.
// also: crash.segv
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  volatile int32_t x = ((const volatile farop_vertex*)polygon->vertices)[polygon->vertex_count].x;
  (void)x;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
