// SPDX-License-Identifier: GPL-3.0-or-later
// Does: has a name of 1 MiB.
// Why:  names go into messages, file names and tables: their length is bounded before they are copied.
#include "../hostile.h"

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  farop_rasterizer* table = hostile_start(host, &hooks);
  static char name[(1 << 20) + 1];
  memset(name, 'a', sizeof name - 1);
  table->name = name;
  return table;
}
