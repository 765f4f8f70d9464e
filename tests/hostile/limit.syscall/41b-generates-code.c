// SPDX-License-Identifier: GPL-3.0-or-later
// Does: writes a function into fresh memory, makes it executable and calls it.
// Why:  generated code can hold any instruction, and no scan of the file has seen it.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
#if defined(__x86_64__)
  static const uint8_t code[] = {0xB8, 42, 0, 0, 0, 0xC3};  // mov $42, %eax; ret
#else
  static const uint8_t code[] = {0x40, 0x05, 0x80, 0x52, 0xC0, 0x03, 0x5F, 0xD6};  // mov w0, #42; ret
#endif
  size_t page = (size_t)sysconf(_SC_PAGESIZE);
  void* memory = mmap(NULL, page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return FAROP_E_MEMORY;
  memcpy(memory, code, sizeof code);
  __builtin___clear_cache((char*)memory, (char*)memory + sizeof code);
  if (mprotect(memory, page, PROT_READ | PROT_EXEC) == 0) {
    int (*function)(void);
    memcpy(&function, &memory, sizeof function);
    if (function() == 42) hostile_found("hostile-hole", "generated code ran", NULL);
  }
  munmap(memory, page);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
