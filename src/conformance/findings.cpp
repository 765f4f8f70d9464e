// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "conformance/examples.h"
#include "conformance/redrawing.h"

namespace farop::conformance {

namespace {

/// Depths that are wrong at small resolutions as well are no matter of overflow.
void name_overflows(std::vector<Problem>& problems) {
  const bool at_small_ones = std::ranges::any_of(problems, [](const Problem& p) {
    return p.severity == Severity::error && p.verdict.starts_with("depth.") &&
           p.verdict != "depth.far-plane" && p.drawing.frame.z <= 512;
  });
  for (Problem& p : problems) {
    if (!at_small_ones || p.else_verdict.empty()) continue;
    p.verdict = p.else_verdict, p.message = p.else_message, p.hint = p.else_hint;
  }
}

bool starts_with_one_of(const std::string& text, std::initializer_list<const char*> heads) {
  return std::ranges::any_of(heads, [&](const char* head) { return text.starts_with(head); });
}

bool is_about_pixels(const Problem& p) {
  return starts_with_one_of(p.verdict, {"fill.", "cov.", "tile.", "depth.", "colour."});
}

/// Where values are wrong, some of them are nearly right.
void drop_drift_of_wrong_values(std::vector<Problem>& problems) {
  for (const std::string kind : {"depth.", "colour."}) {
    const bool wrong = std::ranges::any_of(problems, [&](const Problem& p) {
      return p.severity == Severity::error && p.verdict.starts_with(kind);
    });
    if (!wrong) continue;
    std::erase_if(problems, [&](const Problem& p) {
      return p.severity == Severity::warning && p.verdict == kind + "drift";
    });
  }
}

/// A scene shows what is wrong with pixels in general, too, and cannot tell a wrong colour from another
/// polygon's: what smaller pictures have shown already explains it.
void blame_what_is_known(std::vector<Problem>& problems) {
  const auto of_scene = [](const Problem& p) {
    return starts_with_one_of(p.case_id, {"scene/", "meta/scene-"});
  };
  std::vector<Problem> known;
  for (const Problem& p : problems) {
    if (p.severity != Severity::error || of_scene(p) || !is_about_pixels(p)) continue;
    Problem named;
    named.verdict = p.verdict, named.detail = p.detail, named.message = p.message, named.hint = p.hint;
    known.push_back(std::move(named));
  }
  if (known.empty()) return;
  std::erase_if(problems, [&](const Problem& p) {
    return of_scene(p) && p.severity == Severity::warning && is_about_pixels(p);
  });
  for (Problem& p : problems) {
    if (!of_scene(p) || !(is_about_pixels(p) || p.verdict.starts_with("meta."))) continue;
    const std::string kind = p.verdict.substr(0, p.verdict.find('.') + 1);
    const auto alike =
        std::ranges::find_if(known, [&](const Problem& k) { return k.verdict.starts_with(kind); });
    const Problem& cause = alike == known.end() ? known.front() : *alike;
    p.verdict = cause.verdict, p.detail = cause.detail, p.message = cause.message, p.hint = cause.hint;
  }
}

}  // namespace

void name_problems(const Run& run, const CoverageCause& cause, Outcome& all) {
  const DepthStatistics::Name depth = all.depths.name(),
                              color = (all.colors.wrong > 0 ? all.colors : all.scene_colors).name();
  const bool coverage_known = !cause.verdict.empty();
  const bool accepted = cause.exact && cause.detail == run.options.accepted_rule;
  std::vector<Problem> kept;
  const bool depth_trouble =
      std::ranges::any_of(all.problems, [](const Problem& p) { return p.verdict == "depth.*"; });
  for (Problem& p : all.problems) {
    if (p.verdict == "colour.*" || p.verdict == "colour.wrong")
      p.verdict = color.verdict, p.message = color.message, p.hint = color.hint;
    if (p.verdict == "colour.stale") {
      if (depth_trouble) continue;  // the wrong polygon is in front: known
      p.message = "a hidden polygon's colour shows",
      p.hint = "write depth and colour together, and only where the depth test is won";
    }
    if (p.verdict == "depth.*") p.verdict = depth.verdict, p.message = depth.message, p.hint = depth.hint;
    if (p.verdict == "depth.far-plane")
      p.message = "a polygon at the farthest depth does not appear",
      p.hint = "start the depth buffer beyond the farthest value";
    if (p.verdict.starts_with("cov.")) {
      if (coverage_known) continue;  // named already
      if (p.message.empty()) {
        p.message =
            p.verdict == "cov.missing" ? "pixels are missing" : "pixels are drawn that no polygon covers";
        p.hint = "the smallest example is below";
      }
    }
    // A rule that is not consistent draws some samples twice: whoever accepts it accepts that.
    if (accepted && p.verdict.starts_with("tile.") && !cause.consistent) continue;
    if (p.verdict == "tile.gap" && (cause.verdict.starts_with("fill."))) continue;
    if (p.verdict == "tile.overlap" &&
        (cause.verdict == "fill.rule" || cause.verdict == "fill.neither-end" ||
         cause.verdict == "fill.truncated" || cause.verdict == "fill.half-pixel"))
      continue;
    kept.push_back(std::move(p));
  }
  name_overflows(kept);
  all.problems = std::move(kept);
  if (!cause.verdict.empty() && !accepted) {
    Problem p;
    p.verdict = cause.verdict, p.detail = cause.detail, p.hint = cause.hint;
    p.message = cause.detail.empty() || cause.wrong == 0
                    ? cause.message
                    : fmt::format("{} ({} of {} wrong samples explained)", cause.message, cause.explained,
                                  cause.wrong);
    p.count = cause.wrong, p.explained = cause.explained;
    std::set<std::string> seen;
    for (std::size_t n = 0; n < cause.witnesses.size(); ++n) {
      const Evidence& e = all.evidence[cause.witnesses[n]];
      if (seen.insert(e.case_id).second) p.shown_by.push_back(e.case_id);
    }
    if (!cause.witnesses.empty()) {
      p.drawing = alone(all.evidence[cause.witnesses.front()]);
      p.case_id = all.evidence[cause.witnesses.front()].case_id;
    }
    all.problems.insert(all.problems.begin(), std::move(p));
  }
  drop_drift_of_wrong_values(all.problems);
  blame_what_is_known(all.problems);
}

std::vector<Finding> findings_of(Run& run, const std::vector<Problem>& problems) {
  std::vector<Finding> findings;
  std::map<std::string, std::size_t> index;
  std::vector<std::vector<const Problem*>> members;
  for (const Problem& p : problems) {
    const std::string key = p.verdict + " " + p.detail + " " + severity_letter(p.severity);
    const auto [at, is_new] = index.try_emplace(key, findings.size());
    if (is_new) {
      Finding& f = findings.emplace_back();
      f.verdict = p.verdict, f.detail = p.detail, f.severity = p.severity, f.message = p.message,
      f.hint = p.hint;
      f.trace = p.trace, f.at_polygon = p.polygon;
      members.emplace_back();
    }
    Finding& f = findings[at->second];
    f.count += p.count, f.total += p.count, f.explained += p.count;
    members[at->second].push_back(&p);
    if (!p.shown_by.empty()) {
      f.case_ids = p.shown_by;
      f.explained = p.explained;
    } else if (f.case_ids.empty() || f.case_ids.back() != p.case_id) {
      f.case_ids.push_back(p.case_id);
    }
  }
  for (std::size_t i = 0; i < findings.size(); ++i) add_examples(run, findings[i], members[i]);
  std::ranges::stable_sort(findings, {}, [](const Finding& f) { return f.severity; });
  return findings;
}

}  // namespace farop::conformance
