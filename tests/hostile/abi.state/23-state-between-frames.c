// SPDX-License-Identifier: GPL-3.0-or-later
// Does: does not clear its depth buffer for a second frame of the same size.
// Why:  frames A, B, A: the third has to equal the first.
// also: det.rerun, cov.missing, frame.blank
// needs: three frames A, B, A of one size in one process
#include "../hostile.h"

static int32_t* kept;
static size_t kept_count;

static farop_status begin(const farop_frame* frame) {
  size_t count = (size_t)frame->width * (size_t)frame->height;
  if (kept && kept_count == count) memcpy(hostile.depth, kept, count * sizeof *kept);
  return FAROP_OK;
}
static farop_status end(void) {
  kept_count = (size_t)hostile.frame.width * (size_t)hostile.frame.height;
  free(kept);
  kept = malloc(kept_count * sizeof *kept);
  if (!kept) return FAROP_E_MEMORY;
  memcpy(kept, hostile.depth, kept_count * sizeof *kept);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.begin = begin, .end = end)
