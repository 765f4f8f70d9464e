// SPDX-License-Identifier: GPL-3.0-or-later
// Does: exports malloc, memcpy, write, exit and __stack_chk_fail.
// Why:  the runner must go on using libc's: the plug-in comes after it in the search order.
#include "../hostile.h"

#define SHOWN __attribute__((visibility("default"), used))

static void caught(const char* name) {
  syscall(SYS_write, STDERR_FILENO, "hostile-hole: interposed ", 25ul);
  unsigned long n = 0;
  while (name[n]) ++n;
  syscall(SYS_write, STDERR_FILENO, name, n);
  syscall(SYS_write, STDERR_FILENO, "\n", 1ul);
}

// Under names of their own in this file, so that it does not call them itself.
SHOWN void* fake_malloc(size_t n) __asm__("malloc");
SHOWN void* fake_malloc(size_t n) {
  (void)n;
  caught("malloc");
  return NULL;
}
SHOWN void fake_free(void* p) __asm__("free");
SHOWN void fake_free(void* p) {
  (void)p;
  caught("free");
}
SHOWN void* fake_memcpy(void* to, const void* from, size_t n) __asm__("memcpy");
SHOWN void* fake_memcpy(void* to, const void* from, size_t n) {
  (void)from, (void)n;
  caught("memcpy");
  return to;
}
SHOWN ssize_t fake_write(int fd, const void* bytes, size_t n) __asm__("write");
SHOWN ssize_t fake_write(int fd, const void* bytes, size_t n) {
  (void)fd, (void)bytes;
  caught("write");
  return (ssize_t)n;
}
SHOWN ssize_t fake_sendmsg(int fd, const void* message, int flags) __asm__("sendmsg");
SHOWN ssize_t fake_sendmsg(int fd, const void* message, int flags) {
  (void)fd, (void)message, (void)flags;
  caught("sendmsg");
  return -1;
}
SHOWN void fake_stack_chk_fail(void) __asm__("__stack_chk_fail");
SHOWN void fake_stack_chk_fail(void) {
  caught("__stack_chk_fail");
}

// The rasterizer of the header calls malloc and memcpy: they are libc's as long as the search order is right.
HOSTILE_PLUGIN()
