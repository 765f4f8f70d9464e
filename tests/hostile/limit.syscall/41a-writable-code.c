// SPDX-License-Identifier: GPL-3.0-or-later
// Does: makes its own code writable and writes one byte of it, the one that is there.
// Why:  code that changes after it was checked was not checked.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
  uintptr_t code = (uintptr_t)&deed;
  int result = mprotect((void*)(code / page * page), page, PROT_READ | PROT_WRITE | PROT_EXEC);
  hostile_must_fail("mprotect of code", result);
  if (result == 0) *(volatile uint8_t*)code = *(volatile uint8_t*)code;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
