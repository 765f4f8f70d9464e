// SPDX-License-Identifier: GPL-3.0-or-later
// Does: leaves the x87 unit at single precision.
// Why:  long double would silently lose digits.
// only: x86_64
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  uint16_t control;
  __asm__ volatile("fnstcw %0" : "=m"(control));
  control &= (uint16_t)~0x0300;
  __asm__ volatile("fldcw %0" : : "m"(control));
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
