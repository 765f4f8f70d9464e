// SPDX-License-Identifier: GPL-3.0-or-later
// Does: never initialises every eighth column of its depth buffer.
// Why:  what malloc returns differs from run to run: filling the heap with 00, FF and A5 shows it.
// also: det.rerun, cov.missing, cov.concave, cov.sliver, cov.off-by-one, frame.blank, depth.wrong
// also: depth.none
#include "../hostile.h"

static farop_status begin(const farop_frame* frame) {
  size_t count = (size_t)frame->width * (size_t)frame->height;
  int32_t* raw = malloc(count * sizeof *raw);  // before the other is freed: never the same block
  if (!raw) return FAROP_E_MEMORY;
  HOSTILE_USE(raw);
  for (size_t i = 0; i < count; ++i)
    if (i % (size_t)frame->width % 8 != 0)
      raw[i] = frame->z_far + 1;
    else
      raw[i] &= INT32_MAX;  // 00: nothing is nearer; FF and A5: everything is
  free(hostile.depth);
  hostile.depth = raw;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.begin = begin)
