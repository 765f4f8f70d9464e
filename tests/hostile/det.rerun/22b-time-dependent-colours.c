// SPDX-License-Identifier: GPL-3.0-or-later
// Does: lets the clock choose the colours.
// Why:  coverage is right, and no two pictures are equal.
// also: det.fill, colour.wrong, colour.range
#include "../hostile.h"

static uint8_t tint;

static farop_status begin(const farop_frame* frame) {
  (void)frame;
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  tint = (uint8_t)((uint64_t)t.tv_nsec * 0x9E3779B97F4A7C15u >> 56);
  return FAROP_OK;
}
static int pixel(int32_t x, int32_t y, uint8_t* rgb) {
  (void)x, (void)y;
  for (int i = 0; i < 3; ++i) rgb[i] = (uint8_t)(rgb[i] ^ tint);
  return 1;
}

HOSTILE_PLUGIN(.begin = begin, .pixel = pixel)
