// SPDX-License-Identifier: GPL-3.0-or-later
// Does: calls _exit(0).
// Why:  no handler of the runner gets a chance.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  _exit(0);
}

HOSTILE_PLUGIN(.before = deed)
