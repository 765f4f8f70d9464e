// SPDX-License-Identifier: GPL-3.0-or-later
// Does: makes a system call with the x32 bit set.
// Why:  the same calls under other numbers, of the same architecture as the filter sees it.
// also: crash.sigsys, pass
// only: x86_64
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  hostile_must_fail("x32 getpid", syscall(0x40000000 + SYS_getpid));
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
