// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "conformance/case_kinds.h"

namespace farop::conformance {

void run_ties(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
  std::uint64_t first = 0, last = 0;
  Framebuffer got;
  Drawing given;
  for (const Drawing& drawing : c.drawings) {
    given = run.maker.as_given(drawing);
    const auto picture = run.picture_of(c, subject, given, out);
    if (!picture) return;
    Expectation expected(given, run.rule);
    if (run.known_rule) expected.add_boundary_of(*run.known_rule);
    for (int y = 0; y < given.frame.y; ++y) {
      for (int x = 0; x < given.frame.x; ++x) {
        const auto covering = expected.covering(x, y);
        if (covering.size() < 2 || (run.skip_boundary && expected.on_boundary(x, y))) continue;
        ++row.judged;
        const auto shows = [&](std::uint32_t k) {
          const ScreenVertex& v = given.polygons[k].front();
          return near(pixel_at(*picture, x, y),
                      {static_cast<std::uint8_t>(v.r), static_cast<std::uint8_t>(v.g),
                       static_cast<std::uint8_t>(v.b)});
        };
        first += shows(covering.front()) ? 1 : 0, last += shows(covering.back()) ? 1 : 0;
      }
    }
    got = *picture;
  }
  if (first == 0 || last == 0) return;
  Problem p;
  p.case_id = row.id, p.verdict = "depth.ties", p.severity = Severity::warning, p.drawing = given,
  p.got = got, p.count = std::min(first, last);
  p.message =
      fmt::format("of equal depths the first drawn wins at {} samples and the last at {}", first, last),
  p.hint = "decide once: < keeps the first, <= the last";
  out.problems.push_back(std::move(p));
}

}  // namespace farop::conformance
