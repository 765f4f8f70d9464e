// SPDX-License-Identifier: GPL-3.0-or-later
// Does: writes 64 MiB into its working directory and the one above.
// Why:  a full disk fails everybody's results.
// also: limit.output
#include "../hostile.h"

static void fill(const char* folder) {
  char path[64];
  hostile_canary(path, sizeof path, folder, "-fill");
  int fd = open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (fd < 0) return;
  unlink(path);  // what is written is gone with the process
  hostile_found("hostile-hole", folder, "file made");
  static char block[1 << 20];
  memset(block, 0x5A, sizeof block);
  for (int i = 0; i < 64; ++i)
    if (write(fd, block, sizeof block) <= 0) break;
  close(fd);
}

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  fill(".");
  fill("..");
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
