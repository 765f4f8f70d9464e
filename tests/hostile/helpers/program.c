// SPDX-License-Identifier: GPL-3.0-or-later
// A program, where a library is expected: rows 50g and 50h.
#include <unistd.h>

int main(void) {
  static const char text[] = "hostile-hole: a program was run\n";
  return write(STDERR_FILENO, text, sizeof text - 1) < 0;
}
