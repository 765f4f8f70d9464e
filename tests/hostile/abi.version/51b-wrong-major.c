// SPDX-License-Identifier: GPL-3.0-or-later
// Does: says it was built for version 2.0.
// Why:  refused with both versions named.
#include "../hostile.h"

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  farop_rasterizer* table = hostile_start(host, &hooks);
  table->abi_version = 2u << 16;
  return table;
}
