// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_reports.h"

#include <algorithm>
#include <vector>

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

std::vector<std::string> names(const CheckReports& r) {
  std::vector<std::string> all{r.html, r.json, r.junit, r.tap, r.csv, r.gradescope};
  std::erase(all, "");
  return all;
}

}  // namespace

bool CheckReports::to_stdout() const {
  return std::ranges::count(names(*this), "-") > 0;
}

void add_check_reports(CLI::App& command, CheckReports& r) {
  const auto file = [&command](const char* name, std::string& value, const char* what) {
    command.add_option(name, value, what)->type_name("FILE")->group("Results");
  };
  file("--report", r.html, "one HTML page with pictures of what is wrong");
  file("--json", r.json, "everything, for programs (share/farop/check.schema.json)");
  file("--junit", r.junit, "for CI servers");
  file("--tap", r.tap, "Test Anything Protocol 13");
  file("--csv", r.csv, "one row a case");
  file("--gradescope", r.gradescope, "results.json of an autograder: 10 points a family");
}

void begin_check_reports(const CheckReports& reports) {
  std::vector<std::string> all = names(reports);
  std::ranges::sort(all);
  if (const auto twice = std::ranges::adjacent_find(all); twice != all.end())
    throw Error(ExitStatus::usage, "two results are to be written to '" + printable(*twice, 4096) + "'",
                "name a file for each");
  // A file that cannot be written is better known before the run than behind it.
  for (const std::string& name : all) OutputFile probe(name);
  if (!reports.gradescope.empty() && reports.gradescope != "-")
    write(reports.gradescope, gradescope_unfinished());
}

void write_check_reports(const CheckReports& reports, const conformance::CheckResult& result) {
  if (!reports.html.empty()) write(reports.html, to_html(result));
  if (!reports.json.empty()) write(reports.json, to_json(result));
  if (!reports.junit.empty()) write(reports.junit, to_junit(result));
  if (!reports.tap.empty()) write(reports.tap, to_tap(result));
  if (!reports.csv.empty()) write(reports.csv, to_csv(result));
  if (!reports.gradescope.empty()) write(reports.gradescope, to_gradescope(result));
}

}  // namespace farop::app
