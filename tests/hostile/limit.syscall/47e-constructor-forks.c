// SPDX-License-Identifier: GPL-3.0-or-later
// Does: forks, opens a socket and a file for writing while it is being loaded.
// Why:  everything must be in force before dlopen.
// also: abi.load
#include <sys/socket.h>

#include "../hostile.h"

__attribute__((constructor)) static void at_load(void) {
  pid_t child = fork();
  if (child == 0) _exit(0);
  hostile_must_fail("fork in a constructor", child);
  hostile_must_fail("socket in a constructor", socket(AF_UNIX, SOCK_STREAM, 0));
  hostile_must_fail("file for writing in a constructor",
                    open(HOSTILE_CANARY, O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
  unlink(HOSTILE_CANARY);
}

HOSTILE_PLUGIN()
