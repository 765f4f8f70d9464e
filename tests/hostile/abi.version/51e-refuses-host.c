// SPDX-License-Identifier: GPL-3.0-or-later
// Does: returns no table, after saying why.
// Why:  the plug-in's own words are the explanation.
// also: abi.load
#include "../hostile.h"

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  farop_rasterizer* table = hostile_start(host, &hooks);
  (void)table;
  host->log(host, FAROP_LOG_ERROR, "this rasterizer needs the tiles of farop 9");
  return NULL;
}
