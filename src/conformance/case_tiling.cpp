// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "conformance/case_kinds.h"

namespace farop::conformance {

void run_tiling(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
  const Drawing given = run.maker.as_given(c.drawings.front());
  Drawing backward = given;
  std::ranges::reverse(backward.polygons);
  const auto one = run.picture_of(c, subject, given, out);
  if (!one) return;
  const auto two = run.picture_of(c, subject, backward, out);
  if (!two) return;
  const Expectation expected(given, run.rule);
  Problem gap, overlap, extra;
  for (int y = 0; y < given.frame.y; ++y) {
    for (int x = 0; x < given.frame.x; ++x) {
      const auto covering = expected.covering(x, y);
      const Color a = pixel_at(*one, x, y), b = pixel_at(*two, x, y);
      ++row.judged;
      const bool drawn = a != run.background();
      const int owner = covering.empty() ? -1 : static_cast<int>(covering[0]);
      if (!covering.empty() && !drawn) gap.wrong.push_back({x, y, Wrong::missing, owner, -1, a});
      if (covering.size() == 1 && drawn && !near(a, b))
        overlap.wrong.push_back({x, y, Wrong::owner, owner, -2, a});
      // Where it should not be: neighbours that overlap beyond the border of the tiling.
      if (covering.empty() && drawn)
        (near(a, b) ? extra : overlap).wrong.push_back({x, y, Wrong::extra, -1, -2, a});
    }
  }
  const auto note = [&](Problem& p, const char* verdict, const char* message, const char* hint) {
    if (p.wrong.empty()) return;
    p.case_id = row.id, p.verdict = verdict, p.message = message, p.hint = hint, p.drawing = given,
    p.got = *one, p.count = p.wrong.size();
    row.wrong += p.wrong.size();
    out.problems.push_back(std::move(p));
  };
  note(gap, "tile.gap", "a pixel inside a tiling belongs to no polygon",
       "every pixel of a shared edge belongs to exactly one of its two polygons");
  note(overlap, "tile.overlap", "a pixel is drawn by two neighbours",
       "every pixel of a shared edge belongs to exactly one of its two polygons");
  note(extra, "cov.extra", "pixels outside a tiling are drawn", "the smallest example is below");
}

}  // namespace farop::conformance
