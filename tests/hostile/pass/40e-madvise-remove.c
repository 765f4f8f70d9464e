// SPDX-License-Identifier: GPL-3.0-or-later
// Does: has the kernel drop the pages of the finished frame through its mapping.
// Why:  madvise is a harmless call that any malloc makes; with this advice it empties shared memory.
// also: frame.blank, frame.background, cov.missing, oob.write-before, oob.write-after, limit.syscall
#include "../hostile.h"

static farop_status end(void) {
  uintptr_t first;
  size_t bytes;
  hostile_frame_pages(&first, &bytes);
  if (madvise((void*)first, bytes, MADV_REMOVE) != 0) hostile_refused("MADV_REMOVE");
  return FAROP_OK;
}

HOSTILE_PLUGIN(.end = end)
