// SPDX-License-Identifier: GPL-3.0-or-later
// Does: calls abort().
// Why:  libc sends the signal with tgkill, which the filter must let through.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  abort();
}

HOSTILE_PLUGIN(.before = deed)
