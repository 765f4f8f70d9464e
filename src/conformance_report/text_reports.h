// SPDX-License-Identifier: GPL-3.0-or-later
// What a check found out, for programs. Each function returns the whole file; nothing is written here. Text
// that a rasterizer can choose is stripped of control characters and escaped as the format asks. Equal
// results give equal bytes, but for run.time_seconds, run.time_started, every "ms" and perf. `words`: the
// language of what is said beside the result, which should be translated() already.
#pragma once

#include <string>

#include "conformance/result.h"
#include "conformance_report/catalogue.h"

namespace farop::conformance_report {

/// One object, schema "farop.check/1" (share/farop/check.schema.json).
std::string to_json(const conformance::CheckResult& result);
/// One line with the case and the corpus it belongs to, with line end: for a file that grows while the check
/// runs.
std::string to_json_line(const conformance::CaseResult& one, const std::string& corpus_hash);
/// testsuite = family, testcase = case. Wrong pictures are failures; crashes, limits and abi.* are errors.
std::string to_junit(const conformance::CheckResult& result);
/// Test Anything Protocol, version 13.
std::string to_tap(const conformance::CheckResult& result);
/// RFC 4180, one row a case; cells that a spreadsheet would take for a formula get an apostrophe.
std::string to_csv(const conformance::CheckResult& result);
/// Gradescope's results.json: ten points a family, in proportion to the cases passed.
std::string to_gradescope(const conformance::CheckResult& result, const Catalogue& words);
/// What Gradescope gets to see when the check does not come to its end: no points, and why.
std::string gradescope_unfinished(const Catalogue& words);

}  // namespace farop::conformance_report
