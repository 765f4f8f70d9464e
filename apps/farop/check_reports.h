// SPDX-License-Identifier: GPL-3.0-or-later
// The files that farop check writes beside its text on the terminal.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "conformance/result.h"

namespace farop::app {

/// File names as given; empty: not asked for; "-": standard output.
struct CheckReports {
  std::string html, json, junit, tap, csv, gradescope;

  /// One of them goes to standard output, where nothing else must go then.
  bool to_stdout() const;
};

void add_check_reports(CLI::App& command, CheckReports& reports);
/// Before the run: what Gradescope sees if the run does not come to its end. Throws Error(usage) where two
/// would share one file, Error(surroundings) where a file cannot be written.
void begin_check_reports(const CheckReports& reports);
/// Each file is there whole or not at all. Throws Error(surroundings).
void write_check_reports(const CheckReports& reports, const conformance::CheckResult& result);

}  // namespace farop::app
