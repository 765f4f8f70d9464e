// SPDX-License-Identifier: GPL-3.0-or-later
// Does: has a table smaller than that of version 1.0.
// Why:  the rest of it is not there to be read.
// also: abi.load, abi.symbol
#include "../hostile.h"

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  farop_rasterizer* table = hostile_start(host, &hooks);
  table->struct_size = offsetof(farop_rasterizer, polygon);
  return table;
}
