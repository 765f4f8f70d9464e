// SPDX-License-Identifier: GPL-3.0-or-later
// Does: tosses a coin for one pixel in eight.
// Why:  a picture that differs from itself cannot be judged by comparing it once.
// also: det.fill, cov.missing, cov.sliver, cov.off-by-one, cov.concave
#include "../hostile.h"

static uint64_t state;

static farop_status begin(const farop_frame* frame) {
  (void)frame;
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  state = (uint64_t)t.tv_nsec * 0x9E3779B97F4A7C15u + hostile.frames + 1;
  return FAROP_OK;
}
static int pixel(int32_t x, int32_t y, uint8_t* rgb) {
  (void)rgb;
  state ^= state << 13, state ^= state >> 7, state ^= state << 17;
  return (x + y) % 8 != 0 || (state >> 32 & 1) != 0;
}

HOSTILE_PLUGIN(.begin = begin, .pixel = pixel)
