// SPDX-License-Identifier: GPL-3.0-or-later
// Does: writes 1 GiB to stdout.
// Why:  the judge must read on, or the writer blocks; and must keep 64 KiB, or it fills its own memory.
#include "../hostile.h"

static void flood(int fd) {
  static char block[1 << 16];
  memset(block, 'x', sizeof block);
  for (int i = 1; i <= 64; ++i) block[i * 1024 - 1] = '\n';
  for (int i = 0; i < 1 << 14; ++i)  // 1 GiB
    if (write(fd, block, sizeof block) < 0) return;
}

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  flood(STDOUT_FILENO);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
