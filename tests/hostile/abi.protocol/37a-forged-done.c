// SPDX-License-Identifier: GPL-3.0-or-later
// Does: sends messages that may mean "done" into every socket it can find and draws no more.
// Why:  "done" merely ends the wait: an unfinished frame is judged as it is.
// also: frame.blank, cov.missing, limit.syscall
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
  // Every size that a fixed message might have, the number in front counting up as kinds of messages do.
  for (int fd = 3; fd < 16; ++fd) {
    if (!hostile_is_control(fd)) continue;
    for (size_t size = 4; size <= 64; size += 4)
      for (uint32_t kind = 0; kind < 8; ++kind) {
        uint32_t message[16] = {kind};
        send_to(fd, message, size);
      }
  }
  hostile.silent = 1;
  return HOSTILE_SKIP;
}

HOSTILE_PLUGIN(.before = deed)
