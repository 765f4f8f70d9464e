// SPDX-License-Identifier: GPL-3.0-or-later
// Does: executes an instruction that does not exist.
// Why:  one more signal to tell apart.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
#if defined(__x86_64__)
  __asm__ volatile("ud2");
#elif defined(__aarch64__)
  __asm__ volatile(".inst 0x00000000");
#else
  __builtin_trap();
#endif
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
