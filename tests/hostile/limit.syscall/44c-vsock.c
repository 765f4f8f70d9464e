// SPDX-License-Identifier: GPL-3.0-or-later
// Does: opens a socket to the host of a virtual machine.
// Why:  walls around IP do not see it.
#include <sys/socket.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  int fd = socket(AF_VSOCK, SOCK_STREAM | SOCK_CLOEXEC, 0);
  hostile_must_fail("vsock", fd);
  if (fd >= 0) close(fd);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
