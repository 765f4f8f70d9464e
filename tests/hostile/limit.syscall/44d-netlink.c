// SPDX-License-Identifier: GPL-3.0-or-later
// Does: opens a netlink socket.
// Why:  talks to the kernel about interfaces, routes, audit.
#include <sys/socket.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  int fd = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, 0);
  hostile_must_fail("netlink", fd);
  if (fd >= 0) close(fd);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
