// SPDX-License-Identifier: GPL-3.0-or-later
// Does: changes the vertices it was given.
// Why:  they are the host's; sorting them in place spoils whatever comes next.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  ((volatile farop_vertex*)(uintptr_t)polygon->vertices)[0].x += 1;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
