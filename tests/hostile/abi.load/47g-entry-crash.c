// SPDX-License-Identifier: GPL-3.0-or-later
// Does: crashes in the entry function.
// Why:  the first call is part of loading.
// also: crash.segv
#include "../hostile.h"

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  hostile_crash();
  static const struct hostile_hooks hooks;
  return hostile_start(host, &hooks);
}
