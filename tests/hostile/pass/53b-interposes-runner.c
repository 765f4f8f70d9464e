// SPDX-License-Identifier: GPL-3.0-or-later
// Does: exports main, the functions of the C++ library and names that a runner might use.
// Why:  symbols of the runner must not be found in a plug-in.
#include "../hostile.h"

#define SHOWN __attribute__((visibility("default"), used, noreturn))

#define FAKE(number, name)                                            \
  SHOWN void fake_##number(void) __asm__(name);                       \
  SHOWN void fake_##number(void) {                                    \
    static const char text[] = "hostile-hole: interposed " name "\n"; \
    syscall(SYS_write, STDERR_FILENO, text, sizeof text - 1);         \
    _exit(0);                                                         \
  }

FAKE(1, "main")
FAKE(2, "_Znwm")
FAKE(3, "_ZdlPv")
FAKE(4, "__cxa_throw")
FAKE(5, "farop_runner_main")
FAKE(6, "farop_runner_done")
FAKE(7, "_ZSt9terminatev")
FAKE(8, "sigaction")
FAKE(9, "recvmsg")
FAKE(10, "prctl")

HOSTILE_PLUGIN()
