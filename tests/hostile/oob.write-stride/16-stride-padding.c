// SPDX-License-Identifier: GPL-3.0-or-later
// Does: writes into the padding behind each row, in every frame that has some.
// Why:  no guard page is near: only the pattern in the padding can tell.
// needs: a frame whose row_bytes exceed 3 * width
#include "../hostile.h"

static farop_status end(void) {
  const farop_frame* f = &hostile.frame;
  for (int32_t y = 0; y < f->height; ++y)
    for (int64_t i = 3 * (int64_t)f->width; i < f->row_bytes && i < 3 * (int64_t)f->width + 3; ++i)
      f->pixels[y * f->row_bytes + i] ^= 0xFF;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.end = end)
