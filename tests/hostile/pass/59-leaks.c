// SPDX-License-Identifier: GPL-3.0-or-later
// Does: allocates 1 MiB per frame and never frees it.
// Why:  right pictures pass; the leak is a warning, and not a large one.
// needs: the warning memory.leak
#include "../hostile.h"

static void* leaked[4096];  // kept, so that only the growth gives it away

static farop_status begin(const farop_frame* frame) {
  void* block = malloc(1 << 20);
  if (!block) return FAROP_E_MEMORY;
  memset(block, 1, 1 << 20);
  leaked[frame->number % 4096] = block;
  HOSTILE_USE(leaked);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.begin = begin)
