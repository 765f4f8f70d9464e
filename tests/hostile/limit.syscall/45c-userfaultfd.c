// SPDX-License-Identifier: GPL-3.0-or-later
// Does: opens a userfaultfd.
// Why:  stops the kernel in the middle of a copy; half of all kernel exploits start with it.
// also: crash.sigsys, pass
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  int fd = (int)syscall(SYS_userfaultfd, O_CLOEXEC | 1 /* user mode only */);
  hostile_must_fail("userfaultfd", fd);
  if (fd >= 0) close(fd);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
