// SPDX-License-Identifier: GPL-3.0-or-later
// Does: leaves flush-to-zero and denormals-are-zero on, as -ffast-math does.
// Why:  the commonest of these, and mostly unintended.
// only: x86_64
#include <xmmintrin.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  _mm_setcsr(_mm_getcsr() | 0x8040);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
