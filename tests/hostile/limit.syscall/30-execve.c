// SPDX-License-Identifier: GPL-3.0-or-later
// Does: becomes /bin/sh.
// Why:  another program in the runner's place, with its descriptors.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  char* const arguments[] = {"sh", "-c", "echo 'hostile-hole: a shell runs' >&2", NULL};
  char* const environment[] = {NULL};
  hostile_must_fail("execve", execve("/bin/sh", arguments, environment));
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
