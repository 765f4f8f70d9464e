// SPDX-License-Identifier: GPL-3.0-or-later
// Failures that end a command, and the exit statuses they map to.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace farop {

/// Exit statuses of every command.
enum class ExitStatus {
  ok = 0,
  input = 1,         ///< the input is at fault, or a check found something
  usage = 2,         ///< the command line is at fault
  plugin = 3,        ///< the plug-in failed or was stopped
  surroundings = 4,  ///< an output cannot be written, memory or time limit of the machine
  internal = 5       ///< our own fault
};

/// A failure with the exit status it leads to. `what()` is the one line for the user, without "error:";
/// `hint` is the remedy, empty when there is none. An empty `what()`: the reason has been reported as a
/// diagnostic already. Thrown for I/O and usage; parsers report to a DiagnosticSink instead.
class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& message, std::string hint = {})
      : std::runtime_error(message), status_(status), hint_(std::move(hint)) {}

  ExitStatus status() const { return status_; }
  const std::string& hint() const { return hint_; }

 private:
  ExitStatus status_;
  std::string hint_;
};

}  // namespace farop
