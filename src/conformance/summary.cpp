// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/summary.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace farop::conformance {
namespace {

/// Tells every case what its findings are.
void mark_cases(CheckResult& result) {
  std::map<std::string, std::vector<const Finding*>> findings;
  for (const Finding& f : result.findings) {
    for (const std::string& id : f.case_ids) findings[id].push_back(&f);
  }
  for (CaseResult& row : result.cases) {
    const auto found = findings.find(row.id);
    if (found == findings.end() || row.status == CaseStatus::skipped) continue;
    for (const Finding* f : found->second) {
      row.verdicts.push_back(f->verdict);
      if (f->severity == Severity::error) row.status = CaseStatus::failed;
      if (f->severity == Severity::warning && row.status == CaseStatus::passed)
        row.status = CaseStatus::warned;
    }
  }
}

void count(const CaseResult& row, FamilyResult& family, Summary& s) {
  ++s.cases;
  family.judged += row.judged, family.wrong += row.wrong, family.ambiguous += row.ambiguous,
      family.milliseconds += row.milliseconds;
  s.judged += row.judged, s.wrong += row.wrong, s.ambiguous += row.ambiguous;
  switch (row.status) {
    case CaseStatus::passed:
      ++family.passed;
      break;
    case CaseStatus::failed:
      ++family.failed, ++s.failed;
      break;
    case CaseStatus::warned:
      ++family.warned, ++s.warned;
      break;
    case CaseStatus::skipped:
      ++family.skipped, ++s.skipped;
      if (family.skip_reason.empty()) family.skip_reason = row.reason;
      break;
  }
}

}  // namespace

void sum_up(std::span<const Case> corpus, CheckResult& result) {
  mark_cases(result);
  std::map<std::string, FamilyResult> families;
  for (std::size_t i = 0; i < corpus.size(); ++i)
    count(result.cases[i], families[corpus[i].family], result.summary);
  double share = 0;
  for (const FamilyFacts& facts : corpus_families()) {
    const auto found = families.find(std::string(facts.name));
    if (found == families.end()) continue;
    FamilyResult family = found->second;
    family.name = facts.name;
    const double all = static_cast<double>(family.passed + family.warned + family.failed + family.skipped);
    share += all == 0 ? 0 : static_cast<double>(family.passed + family.warned) / all;
    if (family.passed + family.warned + family.failed > 0) family.skip_reason.clear();
    result.families.push_back(std::move(family));
  }
  result.summary.score = families.empty() ? 0 : 100 * share / static_cast<double>(families.size());
}

Precision precision_of(std::span<const Finding> findings, std::optional<double> worst_depth,
                       std::optional<double> worst_color) {
  // Stepping with 16 fractional bits adds that much to what rounding does, in the frames of the corpus.
  constexpr double k_stepping = 1.0 / 32;
  const auto class_of = [&](const std::string& family, std::optional<double> worst) -> std::string {
    if (!worst) return "";
    bool drifts = false;
    for (const Finding& f : findings) {
      if (!f.verdict.starts_with(family)) continue;
      if (f.severity == Severity::error) return "wrong";
      drifts = drifts || f.verdict == family + "drift";
    }
    if (drifts) return "drift";
    return *worst == 0 ? "exact" : *worst <= 0.5 + k_stepping ? "nearest" : "within 1";
  };
  return {worst_depth.value_or(0), worst_color.value_or(0), class_of("depth.", worst_depth),
          class_of("colour.", worst_color)};
}

}  // namespace farop::conformance
