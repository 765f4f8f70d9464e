// SPDX-License-Identifier: GPL-3.0-or-later
// Does: has no name.
// Why:  a null pointer where a string belongs.
#include "../hostile.h"

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  farop_rasterizer* table = hostile_start(host, &hooks);
  table->name = NULL;
  return table;
}
