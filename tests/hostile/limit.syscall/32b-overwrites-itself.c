// SPDX-License-Identifier: GPL-3.0-or-later
// Does: opens its own file for writing and writes its first byte, the one that is there.
// Why:  a submission that rewrites itself would be another one the second time.
#define _GNU_SOURCE 1
#include <dlfcn.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  Dl_info self;
  if (dladdr((const void*)(uintptr_t)&deed, &self) == 0 || !self.dli_fname) return FAROP_OK;
  int fd = open(self.dli_fname, O_WRONLY | O_CLOEXEC);
  hostile_must_fail("open for writing", fd);
  if (fd < 0) return FAROP_OK;
  hostile_must_fail("write to itself", (long)pwrite(fd, "\177", 1, 0));
  close(fd);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
