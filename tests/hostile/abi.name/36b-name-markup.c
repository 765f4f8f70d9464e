// SPDX-License-Identifier: GPL-3.0-or-later
// Does: has markup for a name.
// Why:  names are shown in HTML.
#include "../hostile.h"

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  farop_rasterizer* table = hostile_start(host, &hooks);
  table->name = "\"><img onerror=alert(1)>";
  return table;
}
