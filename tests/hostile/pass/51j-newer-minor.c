// SPDX-License-Identifier: GPL-3.0-or-later
// Does: has a larger table of a newer minor version.
// Why:  an innocent: what the host does not know it must not mind.
#include "../hostile.h"

static struct {
  farop_rasterizer table;
  void* younger[8];
} grown;

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  grown.table = *hostile_start(host, &hooks);
  grown.table.struct_size = sizeof grown;
  grown.table.abi_version = FAROP_ABI_VERSION + 7;
  return &grown.table;
}
