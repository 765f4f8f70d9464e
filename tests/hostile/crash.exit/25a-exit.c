// SPDX-License-Identifier: GPL-3.0-or-later
// Does: calls exit(0).
// Why:  exit status 0 is not a pass.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  exit(0);
}

HOSTILE_PLUGIN(.before = deed)
