// SPDX-License-Identifier: GPL-3.0-or-later
// Does: sends random bytes of random lengths into every socket it can find, with descriptors attached.
// Why:  the judge parses nothing but fixed messages, and takes no descriptor from a runner.
// also: limit.syscall
#include <sys/socket.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  uint64_t state = 0x2545F4914F6CDD1Du;
  uint8_t bytes[4096];
  for (int round = 0; round < 64; ++round) {
    for (size_t i = 0; i < sizeof bytes; ++i) {
      state ^= state << 13, state ^= state >> 7, state ^= state << 17;
      bytes[i] = (uint8_t)state;
    }
    for (int fd = 3; fd < 16; ++fd) {
      if (!hostile_is_control(fd)) continue;
      struct iovec part = {bytes, (size_t)(state >> 32) % sizeof bytes};
      char room[CMSG_SPACE(sizeof(int))];
      memset(room, 0, sizeof room);
      struct msghdr message;
      memset(&message, 0, sizeof message);
      message.msg_iov = &part;
      message.msg_iovlen = 1;
      message.msg_control = room;
      message.msg_controllen = sizeof room;
      struct cmsghdr* attached = CMSG_FIRSTHDR(&message);
      attached->cmsg_level = SOL_SOCKET;
      attached->cmsg_type = SCM_RIGHTS;
      attached->cmsg_len = CMSG_LEN(sizeof(int));
      memcpy(CMSG_DATA(attached), &fd, sizeof fd);
      sendmsg(fd, &message, MSG_DONTWAIT | MSG_NOSIGNAL);
    }
  }
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
