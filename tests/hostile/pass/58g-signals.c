// SPDX-License-Identifier: GPL-3.0-or-later
// Does: resets SIGPIPE, blocks SIGCHLD and ignores SIGSEGV.
// Why:  the runner relies on its own choices, the crash handler first of all.
#include <signal.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  signal(SIGPIPE, SIG_DFL);
  signal(SIGSEGV, SIG_IGN);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGCHLD);
  sigprocmask(SIG_BLOCK, &set, NULL);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
