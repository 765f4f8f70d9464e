// SPDX-License-Identifier: GPL-3.0-or-later
// Does: draws everything right and calls exit(0) in end_frame().
// Why:  the picture was never declared finished.
#include "../hostile.h"

static farop_status end(void) {
  if (hostile.done) exit(0);
  return FAROP_OK;
}
static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed, .end = end)
