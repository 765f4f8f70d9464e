// SPDX-License-Identifier: GPL-3.0-or-later
// Does: reads vertices up to 1 MiB beyond the count.
// Why:  reaches the guard page wherever the array lies in front of it.
// also: crash.segv
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  for (uint32_t i = 0; i < 1u << 16; ++i) {
    volatile int32_t x = ((const volatile farop_vertex*)polygon->vertices)[polygon->vertex_count + i].x;
    (void)x;
  }
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
