// SPDX-License-Identifier: GPL-3.0-or-later
// Does: maps private memory over every frame and draws there.
// Why:  the picture never arrives; nothing crashes.
// also: cov.missing, oob.write-before, oob.write-after, limit.syscall, pass
#include "../hostile.h"

static farop_status begin(const farop_frame* frame) {
  (void)frame;
  uintptr_t first;
  size_t bytes;
  hostile_frame_pages(&first, &bytes);
  mmap((void*)first, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.begin = begin)
