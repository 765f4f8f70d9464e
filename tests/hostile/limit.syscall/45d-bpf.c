// SPDX-License-Identifier: GPL-3.0-or-later
// Does: makes a BPF map.
// Why:  programs in the kernel.
// also: crash.sigsys, pass
#include <linux/bpf.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  union bpf_attr map;
  memset(&map, 0, sizeof map);
  map.map_type = BPF_MAP_TYPE_ARRAY;
  map.key_size = map.value_size = 4;
  map.max_entries = 1;
  int fd = (int)syscall(SYS_bpf, BPF_MAP_CREATE, &map, sizeof map);
  hostile_must_fail("bpf", fd);
  if (fd >= 0) close(fd);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
