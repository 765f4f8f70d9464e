// SPDX-License-Identifier: GPL-3.0-or-later
// Does: returns an address that is not mapped as its table.
// Why:  reading it is a crash of the runner that belongs to loading.
// also: crash.segv, abi.symbol
#include "../hostile.h"

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  (void)host;
  return (const farop_rasterizer*)(uintptr_t)8;
}
