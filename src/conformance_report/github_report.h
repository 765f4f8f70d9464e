// SPDX-License-Identifier: GPL-3.0-or-later
// What GitHub Actions shows of a run.
#pragma once

#include <string>

#include "conformance/result.h"
#include "conformance_report/catalogue.h"

namespace farop::conformance_report {

/// Workflow commands, one line per error or warning: the annotations of a step. GitHub shows the first ten of
/// each; what is left out is said in a notice. For standard output.
std::string to_github_annotations(const conformance::CheckResult& result, const Catalogue& words);

/// A job summary in Markdown, below GitHub's limit of 1 MiB: for the file $GITHUB_STEP_SUMMARY.
std::string to_github_summary(const conformance::CheckResult& result, const Catalogue& words);

}  // namespace farop::conformance_report
