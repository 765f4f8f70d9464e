// SPDX-License-Identifier: GPL-3.0-or-later
// Does: forks, and every child forks: 200 processes in all, each gone after 5 s.
// Why:  the number of processes counts per user, and not at all for root: only the filter or a cgroup
//       stops it.
// also: limit.threads
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  int* budget = mmap(NULL, sizeof *budget, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (budget == MAP_FAILED) return FAROP_E_MEMORY;
  *budget = 200;
  pid_t first = getpid();
  int forked = 0;
  while (__atomic_fetch_sub(budget, 1, __ATOMIC_SEQ_CST) > 0) {
    pid_t child = fork();
    if (child < 0) break;
    forked = 1;
    if (child == 0) hostile_mark();
  }
  if (getpid() != first) {
    hostile_sleep(5);
    _exit(0);
  }
  if (forked) hostile_found("hostile-hole", "fork", NULL);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
