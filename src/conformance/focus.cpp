// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/focus.h"

#include <algorithm>
#include <utility>

namespace farop::conformance {
namespace {

constexpr std::size_t k_large = 64;  ///< polygons: fewer are shrunk as they are

Drawing around(const Drawing& drawing, int x, int y) {
  Drawing few{drawing.frame, {}};
  for (const TestPolygon& polygon : drawing.polygons) {
    if (bounds(polygon, drawing.frame, 1).contains(x, y)) few.polygons.push_back(polygon);
  }
  return few;
}

}  // namespace

void focus(Run& run, Subject& subject, Problem& problem) {
  if (problem.drawing.polygons.size() <= k_large || problem.wrong.empty()) return;
  // The first, the middle and the last one: some are wrong for what was drawn elsewhere.
  for (const std::size_t at : {std::size_t{0}, problem.wrong.size() / 2, problem.wrong.size() - 1}) {
    const WrongSample sample = problem.wrong[at];
    Drawing few = around(problem.drawing, sample.x, sample.y);
    if (few.polygons.empty() || few.polygons.size() == problem.drawing.polygons.size()) continue;
    Delivered d = run.draw(subject, few);
    if (!d.picture) continue;
    const Expectation expected(few, run.rule);
    Judged judged =
        judge(expected, *d.picture, {run.background(), run.skip_boundary, false, run.options.precision});
    const bool again = std::ranges::any_of(judged.wrong, [&](const WrongSample& s) {
      return s.x == sample.x && s.y == sample.y && s.kind == sample.kind;
    });
    if (!again) continue;
    problem.drawing = std::move(few), problem.got = std::move(*d.picture),
    problem.wrong = std::move(judged.wrong);
    return;
  }
}

}  // namespace farop::conformance
