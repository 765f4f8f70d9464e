// SPDX-License-Identifier: GPL-3.0-or-later
// Does: writes through a null pointer.
// Why:  the commonest crash of all; the report has to name the polygon.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  hostile_crash();
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
