// SPDX-License-Identifier: GPL-3.0-or-later
// Does: returns an error from create() and says why.
// Why:  a plug-in may refuse; it is told apart from one that breaks.
// also: abi.load
#include "../hostile.h"

static farop_status FAROP_CALL create(const farop_host* host, void** self) {
  (void)self;
  host->log(host, FAROP_LOG_ERROR, "no licence for this processor");
  return FAROP_E_UNSUPPORTED;
}

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  farop_rasterizer* table = hostile_start(host, &hooks);
  table->create = create;
  return table;
}
