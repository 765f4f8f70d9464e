// SPDX-License-Identifier: GPL-3.0-or-later
// Does: writes pixel (0, height).
// Why:  the row above the last one: an off-by-one in y.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (int i = 0; i < 3; ++i) *(volatile uint8_t*)(hostile_frame_end() + i) ^= 0xFF;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
