// SPDX-License-Identifier: GPL-3.0-or-later
// Does: reads from every socket it can find, so that the runner misses its requests.
// Why:  both ends wait for each other then; the judge's clock has to end it.
// also: pass, limit.time, limit.syscall
// But:  no request is on its way while end_frame() runs, so there is nothing to steal and nothing happens.
#include <sys/socket.h>

#include "../hostile.h"

static farop_status end(void) {
  if (!hostile.done) return FAROP_OK;
  for (double stop = hostile_now() + 0.1; hostile_now() < stop;)
    for (int fd = 3; fd < 16; ++fd) {
      char bytes[256];
      struct iovec part = {bytes, sizeof bytes};
      struct msghdr message;
      memset(&message, 0, sizeof message);
      message.msg_iov = &part;
      message.msg_iovlen = 1;
      if (hostile_is_control(fd)) recvmsg(fd, &message, MSG_DONTWAIT);
    }
  return FAROP_OK;
}
static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed, .end = end)
