// SPDX-License-Identifier: GPL-3.0-or-later
// Does: looks through every descriptor it inherited for a file that has a name.
// Why:  a descriptor that was not closed needs no open().
// also: limit.syscall
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  int strangers = 0;
  for (int fd = 3; fd < 1024; ++fd) {
    struct stat s;
    char name[32];
    if (hostile_fstat(fd, &s) != 0 || S_ISSOCK(s.st_mode) || S_ISFIFO(s.st_mode) || hostile_is_memory(fd))
      continue;
    snprintf(name, sizeof name, "descriptor %d", fd);
    if (S_ISREG(s.st_mode) || S_ISDIR(s.st_mode) || S_ISCHR(s.st_mode))
      hostile_found("hostile-leak", name, NULL), ++strangers;
  }
  if (strangers == 0) hostile_found("hostile-refused", "1021 descriptors", "none is a file");
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
