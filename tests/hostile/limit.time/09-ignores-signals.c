// SPDX-License-Identifier: GPL-3.0-or-later
// Does: blocks and ignores every signal, then loops.
// Why:  nothing but SIGKILL ends it.
#include <signal.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, NULL);
  for (int s = 1; s < NSIG; ++s) signal(s, SIG_IGN);
  hostile_loop();
}

HOSTILE_PLUGIN(.before = deed)
