// SPDX-License-Identifier: GPL-3.0-or-later
#include <csignal>

#include "command_line.h"

int main(int argc, char** argv) {
  // A reader that goes away must give an error message, a full disk an error code, not a silent death.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return farop::app::run_command_line({argv + 1, argv + argc});
}
