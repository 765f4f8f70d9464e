// SPDX-License-Identifier: GPL-3.0-or-later
// Does: is called "../../farop-canary".
// Why:  a name is no path; used as one it would leave the folder.
#include "../hostile.h"

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  farop_rasterizer* table = hostile_start(host, &hooks);
  table->name = "../../" HOSTILE_CANARY;
  return table;
}
