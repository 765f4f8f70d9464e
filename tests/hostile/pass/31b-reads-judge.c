// SPDX-License-Identifier: GPL-3.0-or-later
// Does: opens the judge's program, command line, memory map and descriptors and says so.
// Why:  the judge knows the expected pictures and where the results go.
// also: limit.syscall
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  static const char* const files[] = {"exe", "cmdline", "maps", "status", "fd/3", "fd/4"};
  for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
    char path[64];
    snprintf(path, sizeof path, "/proc/%d/%s", (int)getppid(), files[i]);
    hostile_read(path);
  }
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
