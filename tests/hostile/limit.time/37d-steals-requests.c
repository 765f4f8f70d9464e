// SPDX-License-Identifier: GPL-3.0-or-later
// Does: reads from every socket it can find while it draws, so that the runner misses its next request.
// Why:  both ends wait for each other then; the judge's clock has to end it, and the frame must not count.
// also: abi.protocol, limit.syscall
#include <sys/socket.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  // The judge sends what comes next without waiting for this polygon: the end of the frame at the latest.
  for (double stop = hostile_now() + 5; hostile_now() < stop; hostile_sleep(0.001))
    for (int fd = 3; fd < 16; ++fd) {
      char bytes[256];
      struct iovec part = {bytes, sizeof bytes};
      struct msghdr message;
      memset(&message, 0, sizeof message);
      message.msg_iov = &part;
      message.msg_iovlen = 1;
      if (hostile_is_control(fd) && recvmsg(fd, &message, MSG_DONTWAIT) > 0) return FAROP_OK;
    }
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
