// SPDX-License-Identifier: GPL-3.0-or-later
// Does: needs a library that does not exist.
// Why:  the loader's own words are the explanation.
#include "../hostile.h"

__attribute__((visibility("default"))) void farop_hostile_absent(void);  // from a library that is not kept

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  farop_hostile_absent();
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
