// SPDX-License-Identifier: GPL-3.0-or-later
// Does: returns a status that does not exist.
// Why:  any negative number is a failure, whatever it is meant to say.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  return -4711;
}

HOSTILE_PLUGIN(.before = deed)
