// SPDX-License-Identifier: GPL-3.0-or-later
// Does: listens on an abstract unix socket, and makes a pair of sockets.
// Why:  has no file: two submissions on one machine could meet there.
#include <sys/socket.h>
#include <sys/un.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0), pair[2];
  hostile_must_fail("unix socket", fd);
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) == 0) {
    hostile_found("hostile-hole", "socketpair", NULL);
    close(pair[0]);
    close(pair[1]);
  }
  if (fd < 0) return FAROP_OK;
  struct sockaddr_un name;
  memset(&name, 0, sizeof name);
  name.sun_family = AF_UNIX;
  memcpy(name.sun_path + 1, HOSTILE_MARKER, sizeof HOSTILE_MARKER - 1);
  if (bind(fd, (struct sockaddr*)&name, sizeof name) == 0) listen(fd, 1);
  close(fd);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
