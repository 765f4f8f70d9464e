// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/result.h"

#include <fmt/format.h>

#include <algorithm>

namespace farop::conformance {

char severity_letter(Severity severity) {
  switch (severity) {
    case Severity::error:
      return 'E';
    case Severity::warning:
      return 'W';
    case Severity::information:
      return 'I';
    case Severity::none:
      break;
  }
  return '-';
}

bool CheckResult::has_errors() const {
  return std::ranges::any_of(findings, [](const Finding& f) { return f.severity == Severity::error; });
}

std::string finding_line(const Finding& finding) {
  // What has no samples is counted in cases.
  const bool samples = finding.total > 0;
  std::string detail = finding.detail.empty() ? "-" : finding.detail;
  std::ranges::replace(detail, ' ', '_');
  return fmt::format("{} {} {}  {} {}  {}", severity_letter(finding.severity), finding.verdict, detail,
                     samples ? finding.count : finding.case_ids.size(), samples ? "samples" : "cases",
                     finding.case_ids.empty() ? "-" : finding.case_ids.front());
}

}  // namespace farop::conformance
