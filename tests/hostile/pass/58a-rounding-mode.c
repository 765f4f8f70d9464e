// SPDX-License-Identifier: GPL-3.0-or-later
// Does: leaves the rounding mode upwards.
// Why:  the host's own arithmetic would differ from then on.
#include <fenv.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  fesetround(FE_UPWARD);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
