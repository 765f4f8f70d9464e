// SPDX-License-Identifier: GPL-3.0-or-later
// Does: signals the judge through a process descriptor, of its own making or inherited.
// Why:  the newer way to the same end.
#include <signal.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  pid_t judge = hostile_judge();
  int fd = (int)syscall(SYS_pidfd_open, judge > 0 ? judge : getpid(), 0);
  hostile_must_fail("pidfd_open", fd);
  if (fd >= 0)
    hostile_must_fail("pidfd_send_signal",
                      syscall(SYS_pidfd_send_signal, fd, judge > 0 ? SIGTERM : 0, NULL, 0));
  if (fd >= 0) close(fd);
  for (int other = 3; other < 16; ++other)
    hostile_must_fail("pidfd_send_signal to an inherited one",
                      syscall(SYS_pidfd_send_signal, other, 0, NULL, 0));
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
