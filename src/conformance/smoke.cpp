// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/smoke.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "conformance/case_kinds.h"
#include "conformance/redrawing.h"
#include "conformance/shapes.h"

namespace farop::conformance {
namespace {

struct Smoke {
  const Case* c;
  CaseResult* row;
  Drawing given;
  Framebuffer picture;
};

Judged judged_after(const Run& run, const Smoke& s, const Transform& t) {
  const Expectation expected(s.given, ConsistentRule::lb);
  return judge(expected, t.undo(s.picture, run.background()),
               {run.background(), false, false, PrecisionAsk::normal});
}

bool untouched(const Framebuffer& picture, const Color& background) {
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    if (picture.rgb[i] != background[i % 3]) return false;
  }
  return true;
}

void report(const Smoke& s, Problem p, std::vector<WrongSample> samples, Outcome& out) {
  p.case_id = s.row->id;
  p.drawing = s.given, p.got = s.picture, p.count = samples.size(), p.wrong = std::move(samples);
  s.row->wrong = p.count;
  out.problems.push_back(std::move(p));
}

Problem problem(std::string verdict, std::string detail, std::string message, std::string hint) {
  Problem p;
  p.verdict = std::move(verdict), p.detail = std::move(detail), p.message = std::move(message),
  p.hint = std::move(hint);
  return p;
}

void judge_smoke(const Run& run, const Smoke& s, Outcome& out) {
  judge_picture(run, *s.c, s.given, s.picture, out, *s.row);
  // Wrong coverage counts with that of the family that is about it.
  const Drawing& drawing = s.c->drawings.front();
  if (drawing.polygons.size() != 1) return;
  Evidence e;
  e.case_id = s.row->id, e.name = s.c->name;
  e.polygons = run.pieces_of(drawing.frame, drawing.polygons.front());
  e.got = Bitmap(bounds(drawing.polygons.front(), drawing.frame, 2));
  const Window& w = e.got.window;
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) e.got.set(x, y, pixel_at(s.picture, x, y) != run.background() ? 1 : 0);
  }
  out.evidence.push_back(std::move(e));
}

/// Nothing was drawn anywhere. True: it draws polygons that run the other way round; then the triangles will
/// tell.
bool draws_reversed(Run& run, Subject& subject, const Smoke& s) {
  Drawing other = s.given;
  for (TestPolygon& polygon : other.polygons) polygon = reversed(std::move(polygon));
  const Delivered d = run.draw(subject, other);
  return d.picture && !untouched(*d.picture, run.background());
}

/// Finds what makes all pictures exact when it is undone.
bool undo_whole_frame_mistake(Run& run, const std::vector<Smoke>& drawn, Outcome& out) {
  for (const Transform& t : whole_frame_transforms()) {
    const bool exact =
        std::ranges::all_of(drawn, [&](const Smoke& s) { return judged_after(run, s, t).wrong.empty(); });
    if (!exact) continue;
    const auto s =
        std::ranges::find_if(drawn, [&](const Smoke& d) { return !judged_after(run, d, {}).wrong.empty(); });
    report(*s, problem(t.verdict, t.detail, t.message, t.hint), judged_after(run, *s, {}).wrong, out);
    run.transform = t;
    return true;
  }
  return false;
}

bool loses_background(const Run& run, const std::vector<Smoke>& drawn, Outcome& out) {
  for (const Smoke& s : drawn) {
    const Judged judged = judged_after(run, s, {});
    std::uint64_t outside = 0;
    for (const WrongSample& w : judged.wrong) outside += w.kind == Wrong::extra ? 1 : 0;
    if (2 * outside < judged.judged) continue;
    report(s,
           problem("frame.background", "", "pixels that no polygon covers are changed",
                   "the background is there already: do not clear, and draw covered pixels only"),
           judged.wrong, out);
    return true;
  }
  return false;
}

}  // namespace

std::optional<std::string> run_smoke(Run& run, std::span<const Case> corpus, std::span<CaseResult> rows,
                                     Outcome& out) {
  std::vector<Smoke> drawn;
  const std::unique_ptr<Subject> subject = run.maker.make(0);
  for (std::size_t i = 0; i < corpus.size(); ++i) {
    if (corpus[i].family != "smoke") continue;
    const Drawing given = run.maker.as_given(corpus[i].drawings.front());
    const auto picture = run.picture_of(corpus[i], *subject, given, out);
    rows[i].status = CaseStatus::passed, rows[i].reason.clear();
    if (picture) drawn.push_back({&corpus[i], &rows[i], given, *picture});
  }
  if (std::ranges::any_of(out.problems, [](const Problem& p) { return p.severity == Severity::error; }))
    return "smoke failed: see there";
  const auto judge_all = [&] {
    for (const Smoke& s : drawn) judge_smoke(run, s, out);
    return std::nullopt;
  };
  const bool right =
      std::ranges::all_of(drawn, [&](const Smoke& s) { return judged_after(run, s, {}).wrong.empty(); });
  if (right) return judge_all();
  for (const Smoke& s : drawn) {
    if (s.given.polygons.empty() || judged_after(run, s, {}).wrong.empty()) continue;
    if (leaves_state_behind(run, s.row->id, s.given, out)) return "frames depend on each other";
  }
  const bool blank = std::ranges::all_of(drawn, [&](const Smoke& s) {
    return s.given.polygons.empty() || untouched(s.picture, run.background());
  });
  if (blank) {
    const Smoke& s = *std::ranges::find_if(drawn, [](const Smoke& d) { return !d.given.polygons.empty(); });
    if (draws_reversed(run, *subject, s)) return std::nullopt;
    report(s,
           problem("frame.blank", "", "no pixel changed",
                   "is the polygon function called? does it write to the buffer that it is given?"),
           judged_after(run, s, {}).wrong, out);
    return "nothing is drawn";
  }
  if (undo_whole_frame_mistake(run, drawn, out)) return std::nullopt;
  if (loses_background(run, drawn, out)) return "the background is not kept";
  return judge_all();
}

}  // namespace farop::conformance
