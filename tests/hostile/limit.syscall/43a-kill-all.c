// SPDX-License-Identifier: GPL-3.0-or-later
// Does: asks to signal every process there is, with signal 0.
// Why:  the wall has to refuse the call; if it is missing, signal 0 harms nobody.
#include <signal.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  hostile_must_fail("kill(-1)", kill(-1, 0));
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
