// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "conformance/case_kinds.h"
#include "core/sample_statistics.h"

namespace farop::conformance {
namespace {

/// What takes less than this is as good as nothing: added to every time, so that noise of that size cannot
/// look like growth.
constexpr double k_negligible = 20e-6;
/// Larger drawings are left out once one takes so long, and no drawing of a fifth of that time is made twice.
constexpr double k_too_long = 0.25;
constexpr std::size_t k_fewest_sizes = 3;
constexpr double k_enough_seconds = 0.5;  ///< no more rounds then, but k_fewest_rounds at least
constexpr int k_fewest_rounds = 3;

/// Drawings of one rasterizer, in turns with another's.
struct Stopwatch {
  const SubjectMaker* maker = nullptr;
  std::unique_ptr<Subject> subject;
  std::vector<Drawing> drawings, idle;       ///< as given; with hardly anything to draw in the same frame
  std::vector<std::vector<double>> seconds;  ///< by size
  std::vector<double> best;                  ///< by size: shortest ever

  Stopwatch(const SubjectMaker& rasterizers, const Case& c)
      : maker(&rasterizers),
        subject(rasterizers.make(0)),
        seconds(c.sizes.size()),
        best(c.sizes.size(), 1e9) {
    for (const Drawing& d : c.drawings) {
      drawings.push_back(maker->as_given(d));
      idle.push_back(maker->as_given({d.frame, {d.polygons.front()}}));
      // Growing polygons are the question; growing frames are not.
      if (c.name != "resolution") idle.back().polygons.clear();
    }
  }
};

/// What drawing takes beyond clearing the frame and the like: the faster of two, since a machine has more to
/// do. Nothing where it fails.
std::optional<double> time_of(Run& run, Stopwatch& watch, std::size_t size) {
  double drawn = 0, idle = 0;
  for (int turn = 0; turn < 2; ++turn) {
    for (const bool full : {true, false}) {
      const Delivered d = run.draw(*watch.subject, (full ? watch.drawings : watch.idle)[size]);
      if (!d.picture || d.seconds <= 0) return std::nullopt;
      double& best = full ? drawn : idle;
      best = turn == 0 ? d.seconds : std::min(best, d.seconds);
    }
    if (drawn > k_too_long / 5) break;
  }
  return std::max(0.0, drawn - idle) + k_negligible;
}

/// Measures all sizes, the rasterizers in turns. False: a drawing failed.
bool measure(Run& run, std::vector<Stopwatch>& watches, std::size_t& sizes, int rounds) {
  const auto begun = std::chrono::steady_clock::now();
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t size = 0; size < sizes; ++size) {
      for (Stopwatch& watch : watches) {
        const auto seconds = time_of(run, watch, size);
        if (!seconds) return false;
        watch.seconds[size].push_back(*seconds);
        watch.best[size] = std::min(watch.best[size], *seconds);
        if (*seconds > k_too_long) sizes = std::max(k_fewest_sizes, std::min(sizes, size + 1));
      }
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun;
    if (round + 1 >= k_fewest_rounds && spent.count() > k_enough_seconds) break;
  }
  return true;
}

Estimate growth(const Case& c, const Stopwatch& watch, std::size_t sizes) {
  return growth_exponent(std::span(c.sizes).first(sizes), std::span(watch.seconds).first(sizes));
}

PerfResult result_of(const Case& c, const std::vector<Stopwatch>& watches, std::size_t sizes) {
  PerfResult r;
  r.name = c.name;
  r.sizes.assign(c.sizes.begin(), c.sizes.begin() + static_cast<std::ptrdiff_t>(sizes));
  for (std::size_t i = 0; i < sizes; ++i) r.seconds.push_back(median(watches[0].seconds[i]));
  const Estimate slope = growth(c, watches[0], sizes);
  r.slope = slope.value, r.slope_low = slope.low, r.slope_high = slope.high;
  if (watches.size() < 2) return r;
  for (std::size_t i = 0; i < sizes; ++i) r.reference_seconds.push_back(median(watches[1].seconds[i]));
  const Estimate ratio = paired_ratio(watches[1].seconds[sizes - 1], watches[0].seconds[sizes - 1]);
  r.ratio = ratio.value, r.ratio_low = ratio.low, r.ratio_high = ratio.high;
  return r;
}

/// Beyond the limit for sure, and not because this machine is slower with larger drawings.
bool grows_too_fast(const Case& c, const std::vector<Stopwatch>& watches, std::size_t sizes) {
  const Estimate mine = growth(c, watches[0], sizes);
  if (mine.low <= c.growth_limit) return false;
  // Nothing else running makes the shortest times grow.
  std::vector<std::vector<double>> shortest;
  for (std::size_t i = 0; i < sizes; ++i) shortest.push_back({watches[0].best[i]});
  if (growth_exponent(std::span(c.sizes).first(sizes), shortest).value <= c.growth_limit) return false;
  if (watches.size() < 2) return true;
  const double beyond = c.name == "resolution" ? c.growth_limit : c.growth_limit - 1;
  return mine.low > growth(c, watches[1], sizes).value + beyond;
}

const char* hint_of(const std::string& name) {
  if (name == "resolution")
    return "you visit every pixel of the frame for every polygon: restrict it to the polygon's rows and "
           "columns";
  if (name == "fill") return "do the same small amount of work for every pixel";
  if (name == "setup") return "what a polygon costs must not depend on how many there were";
  if (name == "depth") return "look at each polygon once per pixel, not at all those before it";
  return "sort the edges with a sort of n log n instead of looking for the place of each from the front";
}

}  // namespace

void run_growth(Run& run, const Case& c, Outcome& out, CaseResult& row) {
  if (!run.maker.timed()) {
    row.status = CaseStatus::skipped, row.reason = "its time cannot be told from farop's own";
    return;
  }
  if (run.visits_whole_frame) {
    row.status = CaseStatus::skipped, row.reason = "every polygon takes as long as the whole frame";
    return;
  }
  std::vector<Stopwatch> watches;
  std::size_t sizes = c.sizes.size();
  watches.emplace_back(run.maker, c);
  if (run.options.reference != nullptr) watches.emplace_back(*run.options.reference, c);
  bool measured = measure(run, watches, sizes, 5);
  // Once more, to be sure: a machine that was busy for a moment is no finding.
  bool too_fast = measured && grows_too_fast(c, watches, sizes);
  if (too_fast) {
    for (Stopwatch& watch : watches) watch.seconds.assign(c.sizes.size(), {});
    measured = measure(run, watches, sizes, 7);
    too_fast = measured && grows_too_fast(c, watches, sizes);
  }
  if (!measured) {
    row.status = CaseStatus::skipped, row.reason = "a drawing failed";
    return;
  }
  PerfResult r = result_of(c, watches, sizes);
  Problem p;
  p.case_id = row.id, p.verdict = "perf." + c.name, p.count = 1;
  const auto note = [&](Severity severity, std::string message, std::string hint) {
    p.severity = severity, p.message = std::move(message), p.hint = std::move(hint);
    out.problems.push_back(p);
  };
  if (too_fast) {
    run.visits_whole_frame = c.name == "resolution";
    const double factor = r.sizes.back() / r.sizes.front();
    note(Severity::information,
         fmt::format(
             "{:.0f} times the {} take {:.0f} times as long: growth with exponent {:.2f} ({:.2f} to {:.2f}), "
             "where {:.2f} is expected at most",
             factor, c.unit, r.seconds.back() / r.seconds.front(), r.slope, r.slope_low, r.slope_high,
             c.growth_limit),
         hint_of(c.name));
  }
  const std::optional<double> limit = run.options.perf_limit;
  if (limit && watches.size() > 1 && r.ratio_low > *limit) {
    note(Severity::error,
         fmt::format(
             "it takes {:.1f} ({:.1f} to {:.1f}) times as long as the shipped depth buffer; {} are allowed",
             r.ratio, r.ratio_low, r.ratio_high, *limit),
         "look where the time goes: perf, gprof");
  }
  out.perf.push_back(std::move(r));
}

}  // namespace farop::conformance
