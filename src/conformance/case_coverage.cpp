// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <utility>
#include <vector>

#include "conformance/case_kinds.h"
#include "conformance/shapes.h"

namespace farop::conformance {
namespace {

/// Sorts the pixels of a picture by the polygons whose colours they have. Colours one less than they should
/// be are taken as meant.
void collect(const Run& run, const Drawing& drawing, const Framebuffer& picture,
             std::vector<Evidence>& evidence, std::vector<WrongSample>& strays, std::uint64_t& truncated) {
  std::vector<std::vector<std::size_t>> by_color(32 * 32);
  const auto key = [](int r, int g) {
    return static_cast<std::size_t>(r / 8) * 32 + static_cast<std::size_t>(g / 8);
  };
  for (std::size_t k = 0; k < drawing.polygons.size(); ++k) {
    const ScreenVertex& v = drawing.polygons[k].front();
    by_color[key(v.r, v.g)].push_back(k);
  }
  const Color background = run.background();
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Color got = pixel_at(picture, x, y);
      if (got == background) continue;
      bool known = false;
      for (const std::size_t k : by_color[key(got[0], got[1])]) {
        const ScreenVertex& v = drawing.polygons[k].front();
        if (std::abs(v.r - got[0]) > 1 || std::abs(v.g - got[1]) > 1 || std::abs(v.b - got[2]) > 1) continue;
        known = true;
        if (v.r != got[0] || v.g != got[1] || v.b != got[2]) ++truncated;
        Bitmap& bits = evidence[k].got;
        if (bits.window.contains(x, y)) {
          bits.set(x, y, 1);
        } else {
          ++evidence[k].far_away;
        }
        break;
      }
      if (!known) strays.push_back({x, y, Wrong::extra, -1, -2, got});
    }
  }
}

void add_strays(const Case& c, const Drawing& given, std::vector<WrongSample> strays,
                const Framebuffer& picture, Outcome& out) {
  if (strays.empty()) return;
  // Colours of nobody where a polygon is: a matter of colour, not of coverage.
  const Expectation expected(given, ConsistentRule::lb);
  Problem p;
  std::uint64_t outside = 0;
  for (WrongSample& s : strays) {
    const auto covering = expected.covering(s.x, s.y);
    if (covering.empty()) {
      ++outside;
    } else {
      s.kind = Wrong::color, s.expected_owner = static_cast<int>(covering[0]);
    }
  }
  p.case_id = c.id(), p.drawing = given, p.got = picture, p.count = strays.size(),
  p.wrong = std::move(strays);
  if (outside > 0) {
    p.verdict = "cov.extra", p.message = "pixels outside all polygons have colours of no polygon",
    p.hint = "draw covered pixels only, in the polygon's colour";
  } else {
    p.verdict = "colour.wrong", p.message = "a polygon of one colour is drawn in others",
    p.hint = "the smallest example is below";
    out.colors.add(expected, p.wrong);
  }
  out.problems.push_back(std::move(p));
}

Window tile_window(std::size_t slot) {
  const int x = static_cast<int>(slot % k_tiles) * k_tile, y = static_cast<int>(slot / k_tiles) * k_tile;
  return {x, y, x + k_tile, y + k_tile};
}

}  // namespace

void run_coverage(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
  const Drawing& drawing = c.drawings.front();
  const Drawing given = run.maker.as_given(drawing);
  const auto picture = run.picture_of(c, subject, given, out);
  if (!picture) return;
  std::vector<Evidence> evidence;
  for (const TestPolygon& polygon : drawing.polygons) {
    Evidence& e = evidence.emplace_back();
    e.case_id = row.id, e.name = c.name;
    e.polygons = run.pieces_of(drawing.frame, polygon);
    if (e.polygons.empty()) e.polygons.push_back(polygon);
    e.got = Bitmap(bounds(polygon, drawing.frame, 2));
  }
  std::vector<WrongSample> strays;
  std::uint64_t truncated = 0;
  collect(run, drawing, *picture, evidence, strays, truncated);
  for (Evidence& e : evidence) {
    row.judged += e.got.at.size();
    e.wrong = wrong_samples(e);
    row.wrong += e.wrong;
  }
  add_strays(c, given, std::move(strays), *picture, out);
  note_truncation(run, c, given, truncated, *picture, out);
  // Frames of millions of samples are no use for naming a rule: kept only when wrong.
  for (Evidence& e : evidence) {
    if (e.wrong > 0 || e.got.at.size() <= 20000) out.evidence.push_back(std::move(e));
  }
}

void run_sheet(Run& run, const std::vector<const Case*>& cases, Subject& subject, Outcome& out,
               std::span<CaseResult> rows) {
  const Case& first = *cases.front();
  Drawing sheet{{k_sheet, k_sheet, 512, 256}, {}};
  std::vector<Evidence> evidence;
  for (std::size_t slot = 0; slot < cases.size(); ++slot) {
    const Case& c = *cases[slot];
    const Window w = tile_window(slot);
    TestPolygon polygon =
        moved(c.drawings.front().polygons.front(), w.x0 + k_tile_origin, w.y0 + k_tile_origin);
    paint(polygon, identification_color(slot));
    Evidence& e = evidence.emplace_back();
    e.case_id = c.id(), e.name = c.name, e.got = Bitmap(w);
    e.polygons = run.pieces_of(sheet.frame, polygon);
    sheet.polygons.push_back(std::move(polygon));
  }
  const Drawing given = run.maker.as_given(sheet);
  const auto picture = run.picture_of(first, subject, given, out);
  if (!picture) {
    // Whose fault: one by one, until it has happened a few times.
    int failed = 0;
    for (std::size_t slot = 0; slot < cases.size() && failed < 3; ++slot) {
      const Case& c = *cases[slot];
      Outcome alone;
      if (!run.picture_of(c, subject, run.maker.as_given(c.drawings.front()), alone)) ++failed;
      for (Problem& p : alone.problems) out.problems.push_back(std::move(p));
    }
    return;
  }
  std::vector<WrongSample> strays;
  std::uint64_t truncated = 0;
  collect(run, sheet, *picture, evidence, strays, truncated);
  for (std::size_t slot = 0; slot < evidence.size(); ++slot) {
    evidence[slot].wrong = wrong_samples(evidence[slot]);
    rows[slot].judged = evidence[slot].got.at.size(), rows[slot].wrong = evidence[slot].wrong;
  }
  add_strays(first, given, std::move(strays), *picture, out);
  note_truncation(run, first, given, truncated, *picture, out);
  for (Evidence& e : evidence) out.evidence.push_back(std::move(e));
}

}  // namespace farop::conformance
