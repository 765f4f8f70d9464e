// SPDX-License-Identifier: GPL-3.0-or-later
// Does: connects to a port of this machine.
// Why:  answers could be fetched, results be sent away.
#include <netinet/in.h>
#include <sys/socket.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  int fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  hostile_must_fail("socket", fd);
  if (fd < 0) return FAROP_OK;
  struct sockaddr_in nobody;
  memset(&nobody, 0, sizeof nobody);
  nobody.sin_family = AF_INET;
  nobody.sin_port = htons(9);
  nobody.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  connect(fd, (struct sockaddr*)&nobody, sizeof nobody);
  close(fd);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
