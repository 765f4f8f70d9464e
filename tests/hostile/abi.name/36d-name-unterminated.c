// SPDX-License-Identifier: GPL-3.0-or-later
// Does: has a name that runs into an unreadable page without an end.
// Why:  strlen() on it would be a crash of the harness.
// also: abi.load, crash.segv
#include "../hostile.h"

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks;
  farop_rasterizer* table = hostile_start(host, &hooks);
  size_t page = (size_t)sysconf(_SC_PAGESIZE);
  char* pages = mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED || munmap(pages + page, page) != 0) return NULL;
  memset(pages, 'a', page);
  table->name = pages + page - 16;
  return table;
}
