// SPDX-License-Identifier: GPL-3.0-or-later
// Does: asks for memory that is writable and executable from the start.
// Why:  the other way to the same end: mmap, and growing it with mremap.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  size_t page = (size_t)sysconf(_SC_PAGESIZE);
  void* memory = mmap(NULL, page, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return FAROP_OK;
  hostile_found("hostile-hole", "executable mmap", NULL);
  munmap(memory, page);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
