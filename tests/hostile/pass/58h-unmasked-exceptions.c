// SPDX-License-Identifier: GPL-3.0-or-later
// Does: returns with floating-point exceptions unmasked.
// Why:  the runner's next inexact division would be a SIGFPE.
// only: x86_64
#include <xmmintrin.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  _mm_setcsr(_mm_getcsr() & ~0x1F80u);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
