// SPDX-License-Identifier: GPL-3.0-or-later
// Does: loops for ever.
// Why:  the commonest hang: CPU time decides.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  hostile_loop();
}

HOSTILE_PLUGIN(.before = deed)
