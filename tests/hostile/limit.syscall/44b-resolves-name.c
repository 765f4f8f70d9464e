// SPDX-License-Identifier: GPL-3.0-or-later
// Does: resolves a host name.
// Why:  a question to a name server carries data out.
#include <netdb.h>
#include <sys/socket.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  struct addrinfo hints, *found = NULL;
  memset(&hints, 0, sizeof hints);
  hints.ai_socktype = SOCK_DGRAM;
  if (getaddrinfo("localhost", "9", &hints, &found) == 0) {
    int fd = socket(found->ai_family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    hostile_must_fail("datagram socket", fd);
    if (fd >= 0) close(fd);
    freeaddrinfo(found);
  }
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
