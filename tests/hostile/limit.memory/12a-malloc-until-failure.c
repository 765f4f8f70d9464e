// SPDX-License-Identifier: GPL-3.0-or-later
// Does: allocates and touches memory until malloc fails (at most 8 GiB), then says so.
// Why:  a rasterizer that reports its failure politely has still hit the limit.
#include "../hostile.h"

static void* blocks[8 << 10];  // of 1 MiB: at most 8 GiB

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (size_t n = 0; n < sizeof blocks / sizeof *blocks; ++n) {
    blocks[n] = malloc(1 << 20);
    if (!blocks[n]) return FAROP_E_MEMORY;
    memset(blocks[n], 0x5A, 1 << 20);
    HOSTILE_USE(blocks[n]);
  }
  hostile_found("hostile-hole", "8 GiB allocated", NULL);
  for (size_t n = 0; n < sizeof blocks / sizeof *blocks; ++n) free(blocks[n]);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
