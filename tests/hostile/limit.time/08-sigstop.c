// SPDX-License-Identifier: GPL-3.0-or-later
// Does: stops itself with SIGSTOP.
// Why:  a stopped process neither runs nor ends; waiting for its exit would hang the judge.
// also: limit.syscall
#include <signal.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (double end = hostile_now() + HOSTILE_LONGEST_SECONDS; hostile_now() < end;) raise(SIGSTOP);
  _exit(1);
}

HOSTILE_PLUGIN(.before = deed)
