// SPDX-License-Identifier: GPL-3.0-or-later
// Does: removes, renames, links and changes the mode of the files "farop-canary" around it.
// Why:  a file can be lost without being opened.
#include "../hostile.h"

// Only files of this one name are touched, wherever they are; a test puts them there and compares them
// afterwards.
static const char* const folders[] = {".", "..", "../..", "/", "/tmp", "/var/tmp", "/dev/shm"};

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (size_t i = 0; i < sizeof folders / sizeof *folders; ++i) {
    char path[64], other[64];
    hostile_canary(path, sizeof path, folders[i], "");
    hostile_canary(other, sizeof other, folders[i], "-2");
    hostile_must_fail("chmod", chmod(path, 0));
    hostile_must_fail("link", link(path, other));
    hostile_must_fail("rename", rename(path, other));
    hostile_must_fail("unlink", unlink(other));
    if (!hostile_caged()) continue;  // loaded by hand it makes nothing new
    hostile_must_fail("symlink", symlink("/dev/zero", other));
    hostile_must_fail("mkdir", mkdir(other, 0777));
  }
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
