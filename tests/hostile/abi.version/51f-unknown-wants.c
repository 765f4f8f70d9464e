// SPDX-License-Identifier: GPL-3.0-or-later
// Does: asks for data that version 1.0 does not know.
// Why:  ignoring the wish would give it null pointers later.
// also: abi.load
#include "../hostile.h"

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  farop_rasterizer* table = hostile_start(host, &hooks);
  table->wants = 1u << 31;
  return table;
}
