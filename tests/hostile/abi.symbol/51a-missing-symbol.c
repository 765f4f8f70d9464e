// SPDX-License-Identifier: GPL-3.0-or-later
// Does: exports a function of another name.
// Why:  the message has to say which name is expected.
#include "../hostile.h"

__attribute__((visibility("default"))) const farop_rasterizer* rasterizer_entry(const farop_host* host);

const farop_rasterizer* rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  return hostile_start(host, &hooks);
}
