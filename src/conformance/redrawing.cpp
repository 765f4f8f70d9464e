// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/redrawing.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "conformance/case_kinds.h"
#include "conformance/shapes.h"

namespace farop::conformance {

Drawing alone(const Evidence& e) {
  Drawing d{{64, 64, 512, 256}, e.polygons};
  const Window w = e.got.window;
  const int dx = w.x0 > 0 && w.x1 - w.x0 <= 60 ? w.x0 - 1 : 0,
            dy = w.y0 > 0 && w.y1 - w.y0 <= 60 ? w.y0 - 1 : 0;
  for (TestPolygon& p : d.polygons) p = moved(std::move(p), -dx, -dy);
  for (const TestPolygon& p : d.polygons) {
    for (const ScreenVertex& v : p)
      d.frame.x = std::max(d.frame.x, v.x + 1), d.frame.y = std::max(d.frame.y, v.y + 1);
  }
  return d;
}

bool leaves_state_behind(Run& run, const std::string& case_id, const Drawing& given, Outcome& out) {
  const std::unique_ptr<Subject> life = run.maker.make(0);
  const Delivered first = run.draw(*life, given), second = run.draw(*life, given);
  if (!first.picture) return false;
  const Expectation expected(given, ConsistentRule::lb);
  const JudgeOptions how{run.background(), false, false, PrecisionAsk::normal};
  if (!judge(expected, *first.picture, how).wrong.empty()) return false;
  if (second.picture && judge(expected, *second.picture, how).wrong.size() < 3) return false;
  Problem p;
  p.case_id = case_id, p.verdict = "abi.state", p.drawing = given;
  p.message =
      "the first frame of a life is right, the same frame again is not: something is left over from frame "
      "to frame";
  p.hint = "begin_frame() has to start from nothing: clear your tables there";
  if (second.picture)
    p.got = *second.picture, p.wrong = judge(expected, *second.picture, how).wrong, p.count = p.wrong.size();
  out.problems.push_back(std::move(p));
  return true;
}

bool depends_on_memory(Run& run, const Drawing& given) {
  const std::unique_ptr<Subject> one = run.maker.make(0xA5), two = run.maker.make(0x3C);
  const Delivered a = run.draw(*one, given), b = run.draw(*two, given);
  return a.picture && b.picture && !same_picture(*a.picture, *b.picture);
}

bool carries_state(Run& run, const CoverageCause& cause, Outcome& all) {
  int tried = 0;
  for (const std::size_t w : cause.witnesses) {
    if (++tried > 3) break;
    const Evidence& e = all.evidence[w];
    if (leaves_state_behind(run, e.case_id, alone(e), all)) return true;
  }
  return false;
}

bool does_not_repeat(Run& run, const CoverageCause& cause, const Outcome& all) {
  const std::unique_ptr<Subject> life = run.maker.make(0);
  int tried = 0;
  for (std::size_t n = 0; n < cause.witnesses.size() && tried < 5; ++n) {
    const Drawing given = alone(all.evidence[cause.witnesses[n]]);
    // In a large picture it may well happen again.
    if (window_of(given.frame).samples() > 64 * 64) continue;
    ++tried;
    const Delivered d = run.draw(*life, given);
    if (!d.picture) return false;
    const Expectation expected(given, ConsistentRule::lb);
    if (!judge(expected, *d.picture, {run.background(), false, false, PrecisionAsk::normal}).wrong.empty())
      return false;
  }
  return tried > 0;
}

}  // namespace farop::conformance
