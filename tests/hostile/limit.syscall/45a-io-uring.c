// SPDX-License-Identifier: GPL-3.0-or-later
// Does: sets up an io_uring.
// Why:  its operations open files and sockets behind a filter of system calls.
// also: crash.sigsys, pass
#include <linux/io_uring.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  struct io_uring_params parameters;
  memset(&parameters, 0, sizeof parameters);
  int fd = (int)syscall(SYS_io_uring_setup, 8, &parameters);
  hostile_must_fail("io_uring_setup", fd);
  if (fd >= 0) close(fd);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
