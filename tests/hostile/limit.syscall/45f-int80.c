// SPDX-License-Identifier: GPL-3.0-or-later
// Does: enters the kernel as a 32-bit program does.
// Why:  the numbers mean other calls there: a filter that looks at numbers alone is blind.
// also: crash.sigsys, crash.segv, pass
// only: x86_64
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  long result;
  __asm__ volatile("int $0x80" : "=a"(result) : "a"(20) : "memory", "r8", "r9", "r10", "r11");  // 20: getpid
  if (result == getpid()) hostile_found("hostile-hole", "int 0x80", NULL);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
