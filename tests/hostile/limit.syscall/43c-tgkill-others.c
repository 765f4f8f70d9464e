// SPDX-License-Identifier: GPL-3.0-or-later
// Does: signals a thread of the judge with tgkill and tkill.
// Why:  tgkill is allowed for abort(): to the own process only.
#include <signal.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  pid_t judge = hostile_judge();
  if (judge == 0) judge = 1;
  hostile_must_fail("tgkill", syscall(SYS_tgkill, judge, judge, hostile_judge() > 0 ? SIGTERM : 0));
  hostile_must_fail("tkill", syscall(SYS_tkill, judge, 0));
  siginfo_t info;
  memset(&info, 0, sizeof info);
  info.si_code = SI_QUEUE;
  hostile_must_fail("rt_sigqueueinfo", syscall(SYS_rt_sigqueueinfo, judge, 0, &info));
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
