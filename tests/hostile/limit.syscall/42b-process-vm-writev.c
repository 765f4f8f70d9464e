// SPDX-License-Identifier: GPL-3.0-or-later
// Does: writes into the judge's memory with process_vm_writev.
// Why:  needs no attaching; the same permission.
// also: crash.sigsys
#include <sys/uio.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  pid_t judge = hostile_judge();
  char byte = 0;
  struct iovec here = {&byte, 1}, there = {NULL, 1};  // address 0: nothing is changed if the wall is missing
  long result = syscall(SYS_process_vm_writev, judge > 0 ? judge : getpid(), &here, 1ul, &there, 1ul, 0ul);
  // EFAULT: the kernel was ready to write and found no memory at 0.
  if (result >= 0 || (judge > 0 && errno == EFAULT)) hostile_found("hostile-hole", "process_vm_writev", NULL);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
