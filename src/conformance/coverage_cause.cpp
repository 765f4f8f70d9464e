// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/coverage_cause.h"

#include <vector>

#include "conformance/redrawing.h"

namespace farop::conformance {

bool name_coverage_cause(Run& run, Outcome& all, CoverageCause& cause, CheckResult& result) {
  cause = name_coverage(all.evidence);
  result.rule_fingerprint.required = run.options.accepted_rule;
  result.rule_fingerprint.table = fingerprint(all.evidence);
  if (cause.verdict.empty()) {
    result.rule_fingerprint.named = "lb";
    if (run.options.accepted_rule != "lb") {
      cause.verdict = "fill.rule", cause.detail = "lb",
      cause.message = "it follows the fill rule lb, where " + run.options.accepted_rule + " is asked for";
      cause.hint = "--accept-rule lb is the default";
    }
    return true;
  }
  if (!cause.detail.empty() && cause.explained == cause.wrong) {
    result.rule_fingerprint.named = cause.detail;
  } else if (!cause.detail.empty()) {
    result.rule_fingerprint.closest = cause.detail;
    result.rule_fingerprint.closest_explains =
        static_cast<double>(cause.explained) / static_cast<double>(cause.wrong);
  }
  if (carries_state(run, cause, all)) {
    cause = {};
    all.evidence.clear();
    std::erase_if(all.problems,
                  [](const Problem& p) { return p.verdict == "cov.extra" || p.verdict == "colour.wrong"; });
    return false;
  }
  if (does_not_repeat(run, cause, all)) {
    cause.verdict = "cov.extra", cause.detail.clear(), cause.consistent = false;
    cause.message = "samples are wrong that are right when the polygon is drawn again",
    cause.hint = "look for memory that was never written, for threads, or for a random number";
    return true;
  }
  if (cause.consistent) {
    run.rule = cause.rule;
  } else {
    run.skip_boundary = true;
    for (int r = 0; r < k_fill_rules; ++r) {
      if (rule_name(FillRule{static_cast<std::uint8_t>(r)}) == cause.detail)
        run.known_rule = FillRule{static_cast<std::uint8_t>(r)};
    }
    result.notes.push_back(
        "depth and colour are judged inside polygons only, since no consistent fill rule was found");
  }
  return true;
}

}  // namespace farop::conformance
