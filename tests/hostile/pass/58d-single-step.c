// SPDX-License-Identifier: GPL-3.0-or-later
// Does: returns with the single-step flag set and a handler that swallows the traps.
// Why:  every instruction of the runner would trap until it clears the flag.
// also: crash.trap
// only: x86_64
#include <signal.h>

#include "../hostile.h"

static void swallow(int signal_number) {
  (void)signal_number;
}

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  signal(SIGTRAP, swallow);
  __asm__ volatile("pushfq\n\torq $0x100, (%%rsp)\n\tpopfq" : : : "memory", "cc");
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
