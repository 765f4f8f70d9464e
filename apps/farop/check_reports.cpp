// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include "conformance_report/github_report.h"
#include "conformance_report/html_report.h"
#include "conformance_report/text_reports.h"
#include "core/diagnostics.h"
#include "core/error.h"
#include "core/output_file.h"

namespace farop::app {
namespace {

using namespace conformance_report;

void write(const std::string& name, const std::string& text) {
  OutputFile file(name);
  file.write(text);
  file.commit();
}

/// All files but that of --jsonl, which grows and is opened by CaseLines.
std::vector<std::string> whole_files(const CheckReports& r) {
  std::vector<std::string> all{r.html, r.json, r.junit, r.tap, r.csv, r.gradescope};
  std::erase(all, "");
  return all;
}

std::vector<std::string> names(const CheckReports& r) {
  std::vector<std::string> all = whole_files(r);
  if (!r.jsonl.empty()) all.push_back(r.jsonl);
  return all;
}

[[noreturn]] void cannot_write(const std::string& name) {
  throw Error(ExitStatus::surroundings,
              fmt::format("cannot write to '{}': {}", printable(name, 4096), std::strerror(errno)));
}

/// Behind what other steps of the job have put there.
void append_summary(const std::string& text) {
  const char* const name = std::getenv("GITHUB_STEP_SUMMARY");
  if (name == nullptr || *name == '\0') return;
  std::FILE* const file = std::fopen(name, "a");
  if (file == nullptr) cannot_write(name);
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) != 0 || !written) cannot_write(name);
}

}  // namespace

Catalogue CheckReports::words() const {
  return Catalogue(language == "pt" ? Language::portuguese : Language::english);
}

bool CheckReports::to_stdout() const {
  return std::ranges::count(names(*this), "-") > 0;
}

void add_check_reports(CLI::App& command, CheckReports& r) {
  const auto file = [&command](const char* name, std::string& value, const char* what) {
    command.add_option(name, value, what)->type_name("FILE")->group("Results");
  };
  file("--report", r.html, "one HTML page with pictures of what is wrong");
  file("--json", r.json, "everything, for programs (share/farop/check.schema.json)");
  file("--jsonl", r.jsonl, "one line a case, while the check runs");
  file("--junit", r.junit, "for CI servers");
  file("--tap", r.tap, "Test Anything Protocol 13");
  file("--csv", r.csv, "one row a case");
  file("--gradescope", r.gradescope, "results.json of an autograder: 10 points a family");
  command.add_flag("--github", r.github, "annotations and a job summary for GitHub Actions")
      ->group("Results");
  command.add_option("--lang", r.language, "language of sentences [en]")
      ->check(CLI::IsMember({"en", "pt"}))
      ->type_name("en|pt")
      ->group("Results");
}

void begin_check_reports(const CheckReports& reports) {
  std::vector<std::string> all = names(reports);
  // Its commands are lines of standard output.
  if (reports.github) all.emplace_back("-");
  std::ranges::sort(all);
  if (const auto twice = std::ranges::adjacent_find(all); twice != all.end())
    throw Error(ExitStatus::usage, "two results are to be written to '" + printable(*twice, 4096) + "'",
                reports.github && *twice == "-" ? "--github needs standard output: name a file for the other"
                                                : "name a file for each");
  // A file that cannot be written is better known before the run than behind it.
  for (const std::string& name : whole_files(reports)) OutputFile probe(name);
  if (!reports.gradescope.empty() && reports.gradescope != "-")
    write(reports.gradescope, gradescope_unfinished(reports.words()));
}

void write_check_reports(const CheckReports& reports, const conformance::CheckResult& result) {
  const Catalogue words = reports.words();
  if (!reports.html.empty()) write(reports.html, to_html(result, words));
  if (!reports.json.empty()) write(reports.json, to_json(result));
  if (!reports.junit.empty()) write(reports.junit, to_junit(result));
  if (!reports.tap.empty()) write(reports.tap, to_tap(result));
  if (!reports.csv.empty()) write(reports.csv, to_csv(result));
  if (!reports.gradescope.empty()) write(reports.gradescope, to_gradescope(result, words));
  if (reports.github) {
    write("-", to_github_annotations(result, words));
    append_summary(to_github_summary(result, words));
  }
}

void CaseLines::Closer::operator()(std::FILE* file) const {
  if (file != stdout) std::fclose(file);
}

CaseLines::CaseLines(const CheckReports& reports, std::string corpus_hash)
    : name_(reports.jsonl), corpus_hash_(std::move(corpus_hash)), words_(reports.words()) {
  if (name_.empty()) return;
  file_.reset(name_ == "-" ? stdout : std::fopen(name_.c_str(), "w"));
  if (!file_) cannot_write(name_);
}

void CaseLines::add(const conformance::CaseResult& one) {
  if (!file_) return;
  conformance::CaseResult said = one;
  said.reason = words_(said.reason);
  const std::string line = to_json_line(said, corpus_hash_);
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0)
    cannot_write(name_);
}

}  // namespace farop::app
