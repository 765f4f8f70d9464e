// SPDX-License-Identifier: GPL-3.0-or-later
// Does: sends up to 1 GiB into every socket it can find, for 2 s at most.
// Why:  the judge must not collect what it never asked for.
// also: limit.time, limit.syscall
#include <sys/socket.h>

#include "../hostile.h"

static long send_to(int fd, const void* bytes, size_t count) {
  struct iovec part = {(void*)(uintptr_t)bytes, count};
  struct msghdr message;
  memset(&message, 0, sizeof message);
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  return sendmsg(fd, &message, MSG_DONTWAIT | MSG_NOSIGNAL);
}

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  static uint8_t block[1 << 16];
  size_t left = (size_t)1 << 30;
  for (double end = hostile_now() + 2; left > 0 && hostile_now() < end;)
    for (int fd = 3; fd < 16 && left > 0; ++fd)
      if (hostile_is_control(fd) && send_to(fd, block, sizeof block) > 0) left -= sizeof block;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
