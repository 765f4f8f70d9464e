// SPDX-License-Identifier: GPL-3.0-or-later
// The files that farop check writes beside its text on the terminal.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "conformance/result.h"
#include "conformance_report/catalogue.h"

namespace farop::app {

/// File names as given; empty: not asked for; "-": standard output.
struct CheckReports {
  std::string html, json, jsonl, junit, tap, csv, gradescope;
  bool github = false;          ///< annotations on standard output, a summary where GitHub wants it
  std::string language = "en";  ///< of sentences: "en", "pt"

  conformance_report::Catalogue words() const;
  /// One of them goes to standard output, where nothing else must go then.
  bool to_stdout() const;
};

void add_check_reports(CLI::App& command, CheckReports& reports);
/// Before the run: what Gradescope sees if the run does not come to its end. Throws Error(usage) where two
/// would share one file, Error(surroundings) where a file cannot be written.
void begin_check_reports(const CheckReports& reports);
/// Each file is there whole or not at all. `result` is translated already. Throws Error(surroundings).
void write_check_reports(const CheckReports& reports, const conformance::CheckResult& result);

/// The file of --jsonl: a line per case, there as soon as it is written, so that a run that is stopped leaves
/// what it had found.
class CaseLines {
 public:
  /// Empties the file. Throws Error(surroundings), as add() does.
  CaseLines(const CheckReports& reports, std::string corpus_hash);
  void add(const conformance::CaseResult& one);

 private:
  struct Closer {
    void operator()(std::FILE* file) const;
  };
  std::unique_ptr<std::FILE, Closer> file_;
  std::string name_, corpus_hash_;
  conformance_report::Catalogue words_;
};

}  // namespace farop::app
