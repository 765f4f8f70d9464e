// SPDX-License-Identifier: GPL-3.0-or-later
// Does: returns with the alignment-check flag set.
// Why:  the runner would die of SIGBUS at its next unaligned access, and be blamed.
// also: crash.bus
// only: x86_64
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  __asm__ volatile("pushfq\n\torq $0x40000, (%%rsp)\n\tpopfq" : : : "memory", "cc");
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
