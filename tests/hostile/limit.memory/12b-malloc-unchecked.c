// SPDX-License-Identifier: GPL-3.0-or-later
// Does: allocates and touches memory (at most 8 GiB) without looking whether malloc failed.
// Why:  dies of a null pointer in the end; the cause is the memory limit.
// also: crash.segv
#include "../hostile.h"

static void* blocks[8 << 10];  // of 1 MiB: at most 8 GiB

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (size_t n = 0; n < sizeof blocks / sizeof *blocks; ++n) {
    blocks[n] = malloc(1 << 20);
    for (size_t i = 0; i < 1 << 20; i += 4096) ((volatile char*)blocks[n])[i] = 1;
  }
  hostile_found("hostile-hole", "8 GiB allocated", NULL);
  for (size_t n = 0; n < sizeof blocks / sizeof *blocks; ++n) free(blocks[n]);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
