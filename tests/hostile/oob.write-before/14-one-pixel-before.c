// SPDX-License-Identifier: GPL-3.0-or-later
// Does: writes pixel (-1, 0) of an array that starts at the frame.
// Why:  the smallest step off the frame has to be seen and named by row and column.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (int i = 1; i <= 3; ++i) *(volatile uint8_t*)(hostile.frame.pixels - i) ^= 0xFF;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
