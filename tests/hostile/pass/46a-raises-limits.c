// SPDX-License-Identifier: GPL-3.0-or-later
// Does: raises all of its own limits to infinity.
// Why:  refused, or without effect: limits are for the one who set them.
// also: limit.syscall
#include <sys/resource.h>

#include "../hostile.h"

// Raises the hard limit if that is possible at all.
static void raise_limit(int which, const char* what) {
  struct rlimit old, infinite = {RLIM_INFINITY, RLIM_INFINITY};
  if (getrlimit((__rlimit_resource_t)which, &old) == 0 && old.rlim_max == RLIM_INFINITY) return;
  hostile_must_fail(what, setrlimit((__rlimit_resource_t)which, &infinite));
}

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  raise_limit(RLIMIT_CPU, "limit of CPU time");
  raise_limit(RLIMIT_AS, "limit of address space");
  raise_limit(RLIMIT_DATA, "limit of data");
  raise_limit(RLIMIT_FSIZE, "limit of file size");
  raise_limit(RLIMIT_NPROC, "limit of processes");
  raise_limit(RLIMIT_CORE, "limit of core size");
  raise_limit(RLIMIT_NOFILE, "limit of descriptors");
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
