// SPDX-License-Identifier: GPL-3.0-or-later
// The whole run: corpus in, findings out.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "conformance/corpus.h"
#include "conformance/judge.h"
#include "conformance/result.h"
#include "conformance/subject.h"
#include "core/progress.h"

namespace farop::conformance {

struct CheckOptions {
  /// Fill rule that passes: a name of rule_name(); other consistent or named rules stay errors.
  std::string accepted_rule = "lb";
  PrecisionAsk precision = PrecisionAsk::normal;
  int workers = 1;     ///< lives at a time
  bool shrink = true;  ///< look for the smallest example of each finding
  bool repeat = true;  ///< family det
  /// What times are compared with: the shipped depth buffer. Null: with nothing. Outlives the run.
  const SubjectMaker* reference = nullptr;
  /// Times as long as the reference may a rasterizer take; no value: times are information only.
  std::optional<double> perf_limit;
  ProgressFunction progress;
  /// Gets each case once, as soon as its verdict is final: those without fault while their family runs, the
  /// others at the end, when causes have been named. By several threads, but one at a time.
  std::function<void(const CaseResult&)> finished;
  /// Gets the result when all findings are there, before the cases with faults are told: may look for further
  /// causes, and change findings and the verdicts of those cases.
  std::function<void(CheckResult&)> explain;
  /// Asked now and then: true ends the run early; what was found so far is kept.
  std::function<bool()> interrupted;
};

/// Runs the cases in the order of their families. Fills findings, families, cases, rule_fingerprint and
/// summary; plugin and run facts are the caller's. Throws farop::Error for what the machine cannot do.
CheckResult run_check(const std::vector<Case>& corpus, const SubjectMaker& maker,
                      const CheckOptions& options);

}  // namespace farop::conformance
