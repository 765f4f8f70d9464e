// SPDX-License-Identifier: GPL-3.0-or-later
// Does: reads every nameless shared memory while it is being loaded, looking for the word that marks true
//       messages, then answers "done" in the runner's name, in every number there might be, and draws no
//       more.
// Why:  the best forger there is: it knows the protocol. "done" still merely ends the wait.
// also: frame.blank, cov.missing, limit.syscall
#include <sys/socket.h>

#include "../hostile.h"

static uint64_t words[16 * 8];  // of up to 16 memories
static size_t word_count;

__attribute__((constructor)) static void look(void) {
  for (int fd = 3; fd < 64 && word_count + 8 <= sizeof words / sizeof *words; ++fd)
    if (hostile_is_memory(fd) && pread(fd, &words[word_count], 64, 0) == 64) word_count += 8;
}
static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  struct {
    uint32_t kind, serial;
    uint64_t word;
    uint32_t rest[8];
  } message;
  for (size_t w = 0; w < word_count; ++w) {
    if (words[w] >> 32 == 0) continue;  // too small to be a secret
    for (uint32_t kind = 1; kind <= 4; ++kind)
      for (uint32_t serial = 1; serial <= 32; ++serial)
        for (int fd = 3; fd < 16; ++fd) {
          if (!hostile_is_control(fd)) continue;
          memset(&message, 0, sizeof message);
          message.kind = kind;
          message.serial = serial;
          message.word = words[w];
          struct iovec part = {&message, 40};
          struct msghdr whole;
          memset(&whole, 0, sizeof whole);
          whole.msg_iov = &part;
          whole.msg_iovlen = 1;
          for (part.iov_len = 32; part.iov_len <= sizeof message; part.iov_len += 8)
            sendmsg(fd, &whole, MSG_DONTWAIT | MSG_NOSIGNAL);
        }
  }
  hostile.silent = 1;
  return HOSTILE_SKIP;
}

HOSTILE_PLUGIN(.before = deed)
