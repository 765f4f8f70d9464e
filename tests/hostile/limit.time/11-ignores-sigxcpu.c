// SPDX-License-Identifier: GPL-3.0-or-later
// Does: ignores SIGXCPU, then loops.
// Why:  the soft CPU limit is only a request; the hard one and the watchdog are not.
#include <signal.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  signal(SIGXCPU, SIG_IGN);
  hostile_loop();
}

HOSTILE_PLUGIN(.before = deed)
