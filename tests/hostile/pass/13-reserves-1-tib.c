// SPDX-License-Identifier: GPL-3.0-or-later
// Does: reserves 1 TiB of address space and touches none of it.
// Why:  sparse tables do this; it costs nothing and must not be blamed for memory it never used.
// also: limit.memory
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  void* table =
      mmap(NULL, (size_t)1 << 40, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  HOSTILE_USE(table);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
