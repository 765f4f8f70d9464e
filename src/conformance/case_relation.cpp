// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "conformance/case_kinds.h"
#include "conformance/decided.h"

namespace farop::conformance {

void run_relation(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
  // A cut polygon and the like: under an inconsistent rule they need not agree, and that is known already.
  if (run.skip_boundary) {
    row.status = CaseStatus::skipped, row.reason = "no consistent fill rule";
    return;
  }
  const Drawing a = run.maker.as_given(c.drawings[0]), b = run.maker.as_given(c.drawings[1]);
  const auto one = run.picture_of(c, subject, a, out);
  const auto two = one ? run.picture_of(c, subject, b, out) : std::nullopt;
  if (!one || !two) return;
  std::optional<Bitmap> alike;
  if (c.decided_only)
    alike = decided_alike(Expectation(a, run.rule), Expectation(b, run.rule), c.window, c.shift_x, c.shift_y);
  Problem p;
  for (int y = c.window.y0; y < c.window.y1; ++y) {
    for (int x = c.window.x0; x < c.window.x1; ++x) {
      if (alike && alike->get(x, y) == 0) {
        ++row.ambiguous;
        continue;
      }
      ++row.judged;
      const Color got = pixel_at(*two, x + c.shift_x, y + c.shift_y);
      // The frame's last column and row are cut off in the smaller frame under some rules.
      if (c.name == "crop" && (x == 0 || y == 0 || x == c.window.x1 - 1 || y == c.window.y1 - 1)) continue;
      if (!near(pixel_at(*one, x, y), got))
        p.wrong.push_back({x + c.shift_x, y + c.shift_y, Wrong::color, -1, -2, got});
    }
  }
  if (p.wrong.empty()) return;
  row.wrong += p.wrong.size();
  p.case_id = row.id, p.verdict = "meta." + c.name, p.drawing = b, p.got = *two, p.count = p.wrong.size();
  p.message = "two pictures that must be equal are not: " + c.purpose, p.hint = "compare both pictures";
  out.problems.push_back(std::move(p));
}

}  // namespace farop::conformance
