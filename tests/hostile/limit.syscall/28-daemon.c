// SPDX-License-Identifier: GPL-3.0-or-later
// Does: forks twice into a session of its own; the daemon writes into the frame 3 s later.
// Why:  it has left the process group: only the filter, or a judge that is subreaper, gets hold of it.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  pid_t child = fork();
  if (child > 0) hostile_found("hostile-hole", "fork", NULL);
  if (child != 0) return FAROP_OK;
  hostile_mark();
  setsid();
  if (fork() != 0) _exit(0);
  for (int i = 0; i < 30; ++i) hostile_sleep(0.1);
  hostile_found("hostile-hole", "the daemon lives", NULL);
  *(volatile uint8_t*)hostile.frame.pixels ^= 0xFF;
  _exit(0);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
