// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/check.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "conformance/case_kinds.h"
#include "conformance/coverage_cause.h"
#include "conformance/findings.h"
#include "conformance/run.h"
#include "conformance/smoke.h"
#include "conformance/summary.h"

namespace farop::conformance {
namespace {

/// What is drawn in one go: a case, or the tiles of a sheet.
struct Unit {
  std::vector<std::size_t> cases;
  bool sheet = false;
};

/// The rasterizer ended, or did not even get that far.
bool is_failure(const Problem& p) {
  return p.severity == Severity::error && p.got.rgb.empty() && p.wrong.empty() && p.count == 0;
}

class Checker {
 public:
  Checker(const std::vector<Case>& corpus, const SubjectMaker& maker, const CheckOptions& options)
      : corpus_(corpus),
        options_(options),
        run_(maker, options),
        rows_(corpus.size()),
        told_(corpus.size()) {}

  CheckResult run() {
    for (std::size_t i = 0; i < corpus_.size(); ++i) {
      rows_[i].id = corpus_[i].id(), rows_[i].purpose = corpus_[i].purpose;
      rows_[i].status = CaseStatus::skipped, rows_[i].reason = "not reached";
    }
    run_families();
    name_problems(run_, cause_, all_);
    result_.findings = findings_of(run_, all_.problems);
    result_.cases = std::move(rows_);
    result_.perf = std::move(all_.perf);
    sum_up(corpus_, result_);
    if (options_.explain) options_.explain(result_);
    tell_the_rest();
    Summary& s = result_.summary;
    s.precision = precision_of(result_.findings, all_.worst_depth, all_.worst_color);
    s.renders = run_.renders();
    s.verdict = result_.has_errors() ? "fail" : options_.accepted_rule != "lb" ? "pass.other-rule" : "pass";
    if (options_.interrupted && options_.interrupted()) s.verdict = "interrupted";
    return std::move(result_);
  }

 private:
  void run_families() {
    if (const auto why = run_smoke(run_, corpus_, rows_, all_)) {
      for (CaseResult& row : rows_) {
        if (row.status == CaseStatus::skipped) row.reason = *why;
      }
      return;
    }
    run_family("regress");
    done_ += static_cast<std::size_t>(std::ranges::count(corpus_, "smoke", &Case::family));
    run_family("cov");
    if (stop_ || !name_coverage_cause(run_, all_, cause_, result_)) return;
    for (const char* family : {"tile", "depth", "colour", "meta", "abi", "mem", "scene", "x"})
      run_family(family);
    if (options_.repeat) run_family("det");
    measure_growth();
  }

  /// One case after another, with nothing beside it, and only where the pictures are right.
  void measure_growth() {
    const bool wrong =
        std::ranges::any_of(all_.problems, [](const Problem& p) { return p.severity == Severity::error; });
    if (!wrong && cause_.verdict.empty()) return run_family("perf", 1);
    for (std::size_t i = 0; i < corpus_.size(); ++i) {
      if (corpus_[i].family == "perf") rows_[i].reason = "times of wrong pictures are not worth measuring";
    }
  }

  std::vector<Unit> units_of(const std::string& family) const {
    std::vector<Unit> units;
    for (std::size_t i = 0; i < corpus_.size(); ++i) {
      if (corpus_[i].family != family) continue;
      const bool joins = corpus_[i].tile && !units.empty() && units.back().sheet &&
                         units.back().cases.size() < std::size_t{k_tiles} * k_tiles;
      if (!joins) units.push_back({{}, corpus_[i].tile});
      units.back().cases.push_back(i);
    }
    return units;
  }

  void run_family(const std::string& family, int at_a_time = 64) {
    const std::vector<Unit> units = units_of(family);
    std::vector<Outcome> outcomes(units.size());
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex mutex;
    std::vector<bool> ready(units.size());
    std::size_t told = 0;
    const auto work = [&] {
      try {
        std::unique_ptr<Subject> subject;
        for (std::size_t i = next++; i < units.size() && !stop_; i = next++) {
          if (!subject) subject = run_.maker.make(0);
          run_unit(units[i], *subject, outcomes[i]);
          const std::lock_guard lock(mutex);
          done_ += units[i].cases.size();
          // In the order of the corpus, whatever is ready first.
          for (ready[i] = true; told < units.size() && ready[told]; ++told)
            tell_faultless(units[told], outcomes[told]);
          if (options_.progress) options_.progress(done_, corpus_.size());
          if (options_.interrupted && options_.interrupted()) stop_ = true;
          for (const Problem& p : outcomes[i].problems) {
            if (is_failure(p) && ++crashes_[p.verdict] > 8) stop_ = true;  // it will not get better
          }
        }
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        stop_ = true;
      }
    };
    const int workers = run_.maker.parallel() ? std::clamp(options_.workers, 1, at_a_time) : 1;
    std::vector<std::thread> threads;
    for (int t = 1; t < workers; ++t) threads.emplace_back(work);
    work();
    for (std::thread& t : threads) t.join();
    if (failure) std::rethrow_exception(failure);
    for (Outcome& outcome : outcomes) all_.add(std::move(outcome));
  }

  /// No two threads have the same unit, so each has its rows to itself.
  void run_unit(const Unit& unit, Subject& subject, Outcome& out) {
    const auto begun = std::chrono::steady_clock::now();
    std::vector<const Case*> cases;
    std::vector<CaseResult> rows;
    for (const std::size_t i : unit.cases) {
      cases.push_back(&corpus_[i]);
      rows.push_back(rows_[i]);
      rows.back().status = CaseStatus::passed, rows.back().reason.clear();
    }
    if (unit.sheet) {
      run_sheet(run_, cases, subject, out, rows);
    } else {
      run_case(run_, *cases.front(), subject, out, rows.front());
    }
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows[k].milliseconds = ms / static_cast<double>(rows.size());
      rows_[unit.cases[k]] = std::move(rows[k]);
    }
  }

  void tell_faultless(const Unit& unit, const Outcome& out) {
    if (!options_.finished) return;
    for (const std::size_t i : unit.cases) {
      const CaseResult& row = rows_[i];
      if (row.wrong > 0 || std::ranges::find(out.problems, row.id, &Problem::case_id) != out.problems.end())
        continue;
      options_.finished(row);
      told_[i] = true;
    }
  }

  void tell_the_rest() const {
    for (std::size_t i = 0; options_.finished && i < result_.cases.size(); ++i) {
      if (!told_[i]) options_.finished(result_.cases[i]);
    }
  }

  const std::vector<Case>& corpus_;
  const CheckOptions& options_;
  Run run_;
  std::vector<CaseResult> rows_;
  std::vector<bool> told_;
  Outcome all_;
  CoverageCause cause_;
  CheckResult result_;
  std::atomic<bool> stop_{false};
  std::uint64_t done_ = 0;
  std::map<std::string, int> crashes_;
};

}  // namespace

CheckResult run_check(const std::vector<Case>& corpus, const SubjectMaker& maker,
                      const CheckOptions& options) {
  return Checker(corpus, maker, options).run();
}

}  // namespace farop::conformance
