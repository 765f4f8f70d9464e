// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "check_subjects.h"

namespace farop::app {
namespace {

using namespace conformance;

bool is_repeat(const std::string& verdict) {
  return verdict == "det.rerun" || verdict == "det.fill";
}

CheckResult check_again(const CheckedRun& run, const std::vector<Case>& cases, const RasterizerOptions& how,
                        std::uint64_t seed) {
  CheckOptions options = run.options;
  options.shrink = false;
  options.finished = {}, options.explain = {};
  PrintedLines not_told;
  return run_check(cases, *make_subjects(run.session, run.chosen, how, seed, not_told), options);
}

/// What was not drawn any more has shown nothing.
bool stopped(const CheckedRun& run) {
  return run.options.interrupted && run.options.interrupted();
}

}  // namespace

void blame_threads(const CheckedRun& run, const std::vector<Case>& cases, CheckResult& result) {
  const auto repeats = [](const Finding& f) { return is_repeat(f.verdict); };
  const auto first = std::ranges::find_if(result.findings, repeats);
  if (run.how.threads <= 1 || run.chosen.kind != RasterizerKind::library || run.how.in_process ||
      first == result.findings.end())
    return;
  std::vector<Case> again;
  std::ranges::copy_if(cases, std::back_inserter(again), [](const Case& c) { return c.family == "det"; });
  RasterizerOptions alone = run.how;
  alone.threads = 1;
  if (std::ranges::any_of(check_again(run, again, alone, run.seed).findings, repeats) || stopped(run)) return;
  first->verdict = "det.threads";
  first->message += ", and only with threads";
  first->hint = "your threads race: let no two of them write to, or read and write, the same memory";
  // One cause is told once.
  result.findings.erase(std::remove_if(std::next(first), result.findings.end(), repeats),
                        result.findings.end());
  for (CaseResult& row : result.cases) {
    if (std::erase_if(row.verdicts, is_repeat) > 0) row.verdicts.emplace_back("det.threads");
  }
}

void note_seed_dependence(const CheckedRun& run, const std::vector<Case>& usual, CheckResult& result) {
  constexpr std::uint64_t known = CorpusOptions{}.seed;
  if (run.seed == known || !result.has_errors()) return;
  if (check_again(run, usual, run.how, known).has_errors() || stopped(run)) return;
  result.notes.push_back(
      fmt::format("the same cases pass under --seed {}: what it draws depends on the seed, as if the answers "
                  "to the cases that everybody knows had been stored",
                  known));
}

}  // namespace farop::app
