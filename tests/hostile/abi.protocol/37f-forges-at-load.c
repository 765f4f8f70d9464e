// SPDX-License-Identifier: GPL-3.0-or-later
// Does: sends messages of every size and kind into every socket it can find while it is being loaded.
// Why:  more descriptors are open then than later, and a reply to "load" is awaited.
// also: abi.load, limit.syscall
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

__attribute__((constructor)) static void forge(void) {
  for (int fd = 3; fd < 64; ++fd) {
    if (!hostile_is_control(fd)) continue;
    for (size_t size = 1; size <= 64; ++size)
      for (uint32_t kind = 0; kind < 8; ++kind) {
        uint32_t message[16] = {kind};
        send_to(fd, message, size);
      }
  }
}

HOSTILE_PLUGIN()
