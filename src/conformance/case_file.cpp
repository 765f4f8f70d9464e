// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "conformance/case_kinds.h"
#include "conformance/redrawing.h"

namespace farop::conformance {
namespace {

/// Samples of one polygon or none that look otherwise when the polygons come the other way round.
std::vector<WrongSample> drawn_twice(const Expectation& expected, const Framebuffer& forward,
                                     const Framebuffer& backward, const Color& background) {
  std::vector<WrongSample> wrong;
  for (int y = 0; y < forward.height; ++y) {
    for (int x = 0; x < forward.width; ++x) {
      const auto covering = expected.covering(x, y);
      const Color a = pixel_at(forward, x, y);
      if (covering.size() > 1 || a == background || near(a, pixel_at(backward, x, y))) continue;
      wrong.push_back({x, y, Wrong::owner, covering.empty() ? -1 : static_cast<int>(covering[0]), -2, a});
    }
  }
  return wrong;
}

Problem problem_of(const CaseResult& row, const Drawing& given, const Framebuffer& got) {
  Problem p;
  p.case_id = row.id, p.drawing = given, p.got = got, p.count = 1;
  return p;
}

}  // namespace

void run_file(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
  const auto found = [&] { return !out.problems.empty(); };
  run_pictures(run, c, subject, out, row);
  if (found()) return;
  const Drawing given = run.maker.as_given(c.drawings.front());
  if (leaves_state_behind(run, row.id, given, out)) return;
  Drawing other = given;
  std::ranges::reverse(other.polygons);
  const auto forward = run.picture_of(c, subject, given, out),
             backward = run.picture_of(c, subject, other, out);
  if (!forward || !backward || found()) return;
  const Expectation expected(given, run.rule);
  Problem p = problem_of(row, given, *forward);
  p.wrong = drawn_twice(expected, *forward, *backward, run.background());
  if (!p.wrong.empty()) {
    p.verdict = "tile.overlap", p.message = "a pixel is drawn by two neighbours",
    p.hint = "every pixel of a shared edge belongs to exactly one of its two polygons";
    p.count = p.wrong.size();
    out.problems.push_back(std::move(p));
    return;
  }
  run_probe(run, c, subject, out, row);
  if (found()) return;
  if (!depends_on_memory(run, given)) return;
  p.verdict = "det.fill", p.message = "the picture depends on what fresh memory contains",
  p.hint = "you read memory that was never written: clear it first";
  out.problems.push_back(std::move(p));
}

}  // namespace farop::conformance
