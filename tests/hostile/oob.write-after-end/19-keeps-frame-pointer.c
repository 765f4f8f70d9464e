// SPDX-License-Identifier: GPL-3.0-or-later
// Does: keeps the frame pointer and writes through it in the next frame.
// Why:  the frame lives until end_frame(): later writes must not reach anybody's picture.
// needs: two frames in one process
#include "../hostile.h"

static uint8_t* kept;

static farop_status begin(const farop_frame* frame) {
  if (kept && kept != frame->pixels) *(volatile uint8_t*)kept ^= 0xFF;
  return FAROP_OK;
}
static farop_status end(void) {
  kept = hostile.frame.pixels;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.begin = begin, .end = end)
