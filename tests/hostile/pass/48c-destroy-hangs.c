// SPDX-License-Identifier: GPL-3.0-or-later
// Does: hangs in destroy().
// Why:  the last call comes after the last picture.
// also: limit.time
#include "../hostile.h"

static void FAROP_CALL destroy(void* self) {
  (void)self;
  for (int i = 0; i < HOSTILE_LONGEST_SECONDS; ++i) hostile_sleep(1);
}
static farop_status FAROP_CALL create(const farop_host* host, void** self) {
  *self = (void*)(uintptr_t)host;
  return FAROP_OK;
}

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  farop_rasterizer* table = hostile_start(host, &hooks);
  table->create = create;
  table->destroy = destroy;
  return table;
}
