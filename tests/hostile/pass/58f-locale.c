// SPDX-License-Identifier: GPL-3.0-or-later
// Does: changes the locale of the process.
// Why:  decimal commas in the runner's messages.
#include <locale.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  if (!setlocale(LC_ALL, "pt_PT.UTF-8")) setlocale(LC_ALL, "C.UTF-8");
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
