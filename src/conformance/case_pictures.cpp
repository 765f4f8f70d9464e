// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <string>
#include <utility>

#include "conformance/case_kinds.h"
#include "conformance/focus.h"

namespace farop::conformance {
namespace {

/// A provisional verdict of one wrong sample; those with a star get their name from statistics.
std::string kind_of(const Expectation& expected, const WrongSample& s, const std::string& family) {
  switch (s.kind) {
    case Wrong::missing: {
      const ExactPolygon& p = expected.polygons()[static_cast<std::size_t>(s.expected_owner)];
      // As deep as the farthest depth, in whole numbers.
      const Rational farthest{expected.drawing().frame.z - 1, 1};
      const auto& plane = p.plane(Attribute::z);
      const Rational depth = plane ? plane->at(s.x, s.y) + p.tolerance(Attribute::z).unremarkable
                                   : Rational{p.range(Attribute::z).second, 1};
      return farthest <= depth ? "depth.far-plane" : "cov.missing";
    }
    case Wrong::extra:
      return "cov.extra";
    case Wrong::owner:
      return family == "colour" ? "colour.stale" : "depth.*";
    case Wrong::color:
      break;
  }
  return "colour.*";
}

std::uint64_t corpus_hash_of(const Drawing& d) {
  Case c;
  c.drawings = {d};
  return corpus_hash({c});
}

}  // namespace

void note_truncation(const Run& run, const Case& c, const Drawing& given, std::uint64_t truncated,
                     const Framebuffer& picture, Outcome& out) {
  if (truncated == 0) return;
  Problem p;
  p.case_id = c.id(), p.verdict = "colour.truncation", p.drawing = given, p.got = picture,
  p.count = truncated;
  p.severity = run.options.precision == PrecisionAsk::normal ? Severity::warning : Severity::error;
  p.message = "a constant colour comes out one less",
  p.hint = "round, or interpolate integers: weights that add up to 0.99999 lose one";
  out.problems.push_back(std::move(p));
}

void judge_picture(const Run& run, const Case& c, const Drawing& given, const Framebuffer& picture,
                   Outcome& out, CaseResult& row) {
  Expectation expected(given, run.rule);
  if (run.known_rule) expected.add_boundary_of(*run.known_rule);
  Judged judged = judge(expected, picture, run.judge_options(c));
  row.judged += judged.judged, row.ambiguous += judged.ambiguous, row.wrong += judged.wrong.size();
  // In pictures of 255 levels other resolutions are rounded once more: that says nothing of the rasterizer.
  if (c.family == "colour" && given.frame.color == 256)
    out.worst_color = std::max(out.worst_color, std::optional(judged.worst_color));
  if (c.family == "depth") out.depths.add(expected, picture);
  const auto note = [&](const char* verdict, Severity severity, std::string message, std::string hint,
                        std::uint64_t count) {
    Problem p;
    p.case_id = row.id, p.verdict = verdict, p.severity = severity, p.drawing = given, p.got = picture,
    p.count = count;
    p.message = std::move(message), p.hint = std::move(hint);
    out.problems.push_back(std::move(p));
  };
  note_truncation(run, c, given, judged.truncated, picture, out);
  if (judged.drifted > 0) {
    note("colour.drift", Severity::warning, "colours are off by more than rounding",
         "keep more fractional bits, or use double", judged.drifted);
  }
  if (judged.wrong.empty()) return;
  (c.family == "scene" ? out.scene_colors : out.colors).add(expected, judged.wrong);
  // By kind, so that one cause is told once.
  std::map<std::string, std::vector<WrongSample>> kinds;
  for (const WrongSample& s : judged.wrong) kinds[kind_of(expected, s, c.family)].push_back(s);
  for (auto& [verdict, samples] : kinds) {
    note(verdict.c_str(), Severity::error, "", "", samples.size());
    out.problems.back().wrong = std::move(samples);
  }
}

void run_pictures(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
  std::vector<std::optional<Framebuffer>> pictures;
  for (const Drawing& drawing : c.drawings) {
    const Drawing given = run.maker.as_given(drawing);
    auto picture = run.picture_of(c, subject, given, out);
    if (picture) {
      const std::size_t before = out.problems.size();
      judge_picture(run, c, given, *picture, out, row);
      for (std::size_t i = before; i < out.problems.size(); ++i) focus(run, subject, out.problems[i]);
    }
    pictures.push_back(std::move(picture));
  }
  if (c.kind != CaseKind::state) return;
  for (std::size_t i = 0; i < c.drawings.size(); ++i) {
    for (std::size_t k = i + 1; k < c.drawings.size(); ++k) {
      if (corpus_hash_of(c.drawings[i]) != corpus_hash_of(c.drawings[k]) || !pictures[i] || !pictures[k])
        continue;
      if (same_picture(*pictures[i], *pictures[k])) continue;
      Problem p;
      p.case_id = row.id, p.verdict = "abi.state", p.drawing = c.drawings[k], p.got = *pictures[k];
      p.message = "a frame comes out differently after another one",
      p.hint = "begin_frame() has to start from nothing: clear your tables there";
      p.count = 1;
      out.problems.push_back(std::move(p));
      return;
    }
  }
}

bool same_picture(const Framebuffer& a, const Framebuffer& b) {
  return a.width == b.width && a.height == b.height && a.rgb == b.rgb;
}

}  // namespace farop::conformance
