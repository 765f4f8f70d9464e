// SPDX-License-Identifier: GPL-3.0-or-later
// The second library of 52b-runpath; built again, under a name that is not kept, as the missing one of 52a.
#include <unistd.h>

__attribute__((visibility("default"))) void farop_hostile_second(void);
__attribute__((visibility("default"))) void farop_hostile_absent(void);

void farop_hostile_second(void) {}
void farop_hostile_absent(void) {}

__attribute__((constructor)) static void loaded(void) {
  static const char text[] = "hostile-hole: a second library was loaded\n";
  if (write(STDERR_FILENO, text, sizeof text - 1) < 0) return;
}
