// SPDX-License-Identifier: GPL-3.0-or-later
// Does: writes into the files "farop-canary" around it, and makes them where there are none.
// Why:  stands for the report, the result file, the corpus and other submissions.
#include "../hostile.h"

// Only files of this one name are touched, wherever they are; a test puts them there and compares them
// afterwards.
static const char* const folders[] = {".", "..", "../..", "/", "/tmp", "/var/tmp", "/dev/shm"};

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (size_t i = 0; i < sizeof folders / sizeof *folders; ++i) {
    char path[64];
    hostile_canary(path, sizeof path, folders[i], "");
    // Loaded by hand it changes what is there and creates nothing.
    int fd = open(path, O_WRONLY | O_APPEND | O_CLOEXEC | (hostile_caged() ? O_CREAT : 0), 0666);
    hostile_must_fail("open for writing", fd);
    if (fd < 0) continue;
    if (write(fd, "hostile\n", 8) == 8) hostile_found("hostile-hole", path, "written");
    close(fd);
  }
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
