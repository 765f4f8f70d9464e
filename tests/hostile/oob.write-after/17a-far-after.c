// SPDX-License-Identifier: GPL-3.0-or-later
// Does: writes 64 KiB behind the frame.
// Why:  jumps over a single guard page; whatever lies there, the judge keeps its memory.
// also: oob.write-before, crash.segv
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (int i = 0; i < 3; ++i) *(volatile uint8_t*)(hostile_frame_end() + (64 << 10) + i) ^= 0xFF;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
