// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/examples.h"

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "conformance/case_kinds.h"
#include "conformance/redrawing.h"
#include "conformance/shrink.h"

namespace farop::conformance {
namespace {

constexpr std::size_t k_max_example_polygons = 25'000;

/// A drawing that shows a finding, and what came out.
struct Shown {
  Drawing drawing;
  Framebuffer got;
  std::vector<MeasuredDepth> measured;
};

std::string_view kind_name(Wrong kind) {
  switch (kind) {
    case Wrong::missing:
      return "missing";
    case Wrong::extra:
      return "extra";
    case Wrong::owner:
      return "owner";
    case Wrong::color:
      break;
  }
  return "colour";
}

Example example_of(const Run& run, const Drawing& drawing, const Framebuffer& got, ConsistentRule rule) {
  Example e;
  e.frame = drawing.frame, e.background = run.background();
  // A whole scene is too much for a report: the case shows it again.
  if (drawing.polygons.size() > k_max_example_polygons) return e;
  e.polygons = drawing.polygons;
  e.flat = flat_text(drawing);
  const Expectation expected(drawing, rule);
  e.expected = ideal_picture(expected, run.background());
  for (int y = 0; y < drawing.frame.y; ++y) {
    for (int x = 0; x < drawing.frame.x; ++x) e.owners.push_back(expected.nearest(x, y));
  }
  if (got.rgb.empty()) {
    e.expected = {}, e.owners.clear();
    return e;
  }
  e.got = got;
  const Judged judged = judge(expected, got, {run.background(), false, false, run.options.precision});
  e.wrong_pixels = judged.wrong.size();
  for (const WrongSample& s : judged.wrong) {
    if (e.pixels.size() == k_max_example_pixels) break;
    WrongPixel p;
    p.x = s.x, p.y = s.y, p.kind = kind_name(s.kind), p.expected_owner = s.expected_owner,
    p.got_owner = s.got_owner;
    p.expected = pixel_at(e.expected, s.x, s.y), p.got = s.got;
    if (s.expected_owner >= 0) {
      for (const Attribute a : k_attributes) {
        const auto& plane = expected.polygons()[static_cast<std::size_t>(s.expected_owner)].plane(a);
        if (!plane) continue;
        const Rational v = plane->at(s.x, s.y);
        ExactValue value;
        value.name = std::string(1, "zrgb"[static_cast<std::size_t>(a)]);
        value.numerator = static_cast<std::int64_t>(v.numerator),
        value.denominator = static_cast<std::int64_t>(v.denominator);
        if (a != Attribute::z) value.got = s.got[static_cast<std::size_t>(a) - 1];
        p.values.push_back(std::move(value));
      }
    }
    e.pixels.push_back(std::move(p));
  }
  return e;
}

/// Depths do not show in a picture: what was measured says where they are wrong.
void add_measured(Example& e, const Shown& p, ConsistentRule rule) {
  const Expectation expected(p.drawing, rule);
  e.wrong_pixels = p.measured.size();
  for (const MeasuredDepth& m : p.measured) {
    if (e.pixels.size() == k_max_example_pixels) break;
    WrongPixel pixel;
    pixel.x = m.x, pixel.y = m.y, pixel.kind = "depth";
    pixel.expected_owner = pixel.got_owner = static_cast<int>(m.owner);
    pixel.expected = pixel_at(e.expected, m.x, m.y), pixel.got = pixel_at(e.got, m.x, m.y);
    if (const auto& plane = expected.polygons()[m.owner].plane(Attribute::z)) {
      const Rational v = plane->at(m.x, m.y);
      pixel.values.push_back(
          {"z", static_cast<std::int64_t>(v.numerator), static_cast<std::int64_t>(v.denominator), m.whole});
    }
    e.pixels.push_back(std::move(pixel));
  }
}

/// Whether a drawing shows a verdict of this kind; fills the picture.
bool shows(Run& run, const std::string& verdict, const Drawing& drawing, Subject& subject, Framebuffer& got) {
  const Drawing given = run.maker.as_given(drawing);
  if (given.polygons.empty()) return false;
  Delivered d = run.draw(subject, given);
  if (d.failure) return d.failure->verdict == verdict;
  if (!d.picture) return false;
  for (const SubjectFailure& r : d.remarks) {
    if (r.verdict == verdict) return got = *d.picture, true;
  }
  const bool coverage = verdict.starts_with("cov.") || verdict.starts_with("fill.");
  const Expectation expected(given, coverage ? ConsistentRule::lb : run.rule);
  Judged judged;
  bool found = false;
  if (verdict.starts_with("tile.")) {
    // A neighbour is needed: a gap between two polygons, a sample drawn twice.
    Drawing backward = given;
    std::ranges::reverse(backward.polygons);
    const Delivered b = run.draw(subject, backward);
    if (!b.picture || given.polygons.size() < 2) return false;
    for (int y = 0; y < given.frame.y && !found; ++y) {
      for (int x = 0; x < given.frame.x && !found; ++x) {
        const bool drawn = pixel_at(*d.picture, x, y) != run.background();
        found = verdict == "tile.gap" ? !expected.covering(x, y).empty() && !drawn
                                      : expected.covering(x, y).size() < 2 && drawn &&
                                            !near(pixel_at(*d.picture, x, y), pixel_at(*b.picture, x, y));
      }
    }
  } else {
    judged = judge(expected, *d.picture,
                   {run.background(), run.skip_boundary && !coverage, false, run.options.precision});
    for (const WrongSample& s : judged.wrong) {
      const bool samples = s.kind == Wrong::missing || s.kind == Wrong::extra;
      if (coverage || verdict == "depth.far-plane")
        found = found || samples;
      else if (verdict.starts_with("depth.") || verdict == "colour.stale")
        found = found || s.kind == Wrong::owner;
      else if (verdict.starts_with("colour."))
        found = found || s.kind == Wrong::color;
    }
    if (verdict == "colour.truncation") found = judged.truncated > 0;
  }
  if (found) got = *d.picture;
  return found;
}

/// The same for depths that were measured: by measuring them again, in the manner of the case.
bool shows_measured(Run& run, const Finding& f, const Problem& p, const Drawing& drawing, Subject& subject,
                    Shown& last) {
  const std::size_t slash = p.case_id.find('/');
  Case c;
  c.family = p.case_id.substr(0, slash),
  c.name = p.case_id.substr(slash + 1, p.case_id.find('#') - slash - 1);
  c.kind = CaseKind::probe, c.drawings = {drawing};
  Outcome out;
  CaseResult row;
  run_probe(run, c, subject, out, row);
  for (Problem& again : out.problems) {
    if (again.severity != f.severity || (again.verdict != f.verdict && again.else_verdict != f.verdict))
      continue;
    last = {std::move(again.drawing), std::move(again.got), std::move(again.measured)};
    return true;
  }
  return false;
}

/// Whether a drawing shows a finding as one of its problems did; fills `last` then.
bool shows_alike(Run& run, const Finding& f, const Problem& p, const Drawing& drawing, Subject& subject,
                 Shown& last) {
  if (!p.measured.empty()) return shows_measured(run, f, p, drawing, subject, last);
  const Drawing given = run.maker.as_given(drawing);
  if (f.verdict == "abi.state") {
    Outcome out;
    if (given.polygons.empty() || !leaves_state_behind(run, p.case_id, given, out)) return false;
    last = {given, std::move(out.problems.front().got), {}};
    return true;
  }
  if (f.verdict == "det.fill") {
    if (given.polygons.empty() || !depends_on_memory(run, given)) return false;
    const Delivered d = run.draw(*run.maker.make(0xA5), given);
    last = {given, d.picture.value_or(Framebuffer{}), {}};
    return true;
  }
  Framebuffer seen;
  if (!shows(run, f.verdict, drawing, subject, seen)) return false;
  last = {given, std::move(seen), {}};
  return true;
}

bool can_shrink(const Finding& f) {
  return f.severity != Severity::information && f.verdict != "det.rerun" && f.verdict != "det.threads" &&
         f.verdict != "depth.ties" && !f.verdict.starts_with("meta.") && !f.verdict.starts_with("frame.");
}

}  // namespace

void add_examples(Run& run, Finding& f, std::vector<const Problem*> members) {
  const auto effort = [](const Problem* p) {
    std::size_t corners = 0;
    for (const TestPolygon& polygon : p->drawing.polygons) corners += polygon.size();
    return std::tuple(p->drawing.polygons.size(), corners, p->count);
  };
  std::ranges::stable_sort(members,
                           [&](const Problem* a, const Problem* b) { return effort(a) < effort(b); });
  // A case that draws the same several times is one example.
  std::set<std::string> cases;
  std::erase_if(members, [&](const Problem* p) { return !cases.insert(p->case_id).second; });
  const bool coverage = f.verdict.starts_with("cov.") || f.verdict.starts_with("fill.");
  const std::unique_ptr<Subject> subject = run.maker.make(0);
  const bool stopped = run.options.interrupted && run.options.interrupted();
  for (std::size_t i = 0; i < members.size() && i < 3; ++i) {
    const Problem& p = *members[i];
    Shown last{p.drawing, p.got, p.measured};
    int renders = 0;
    bool alone = f.verdict.starts_with("frame."), small = false;
    if (run.options.shrink && !stopped && i == 0 && can_shrink(f)) {
      const auto fails = [&](const Drawing& d) { return shows_alike(run, f, p, d, *subject, last); };
      alone = fails(p.drawing);
      small = alone;
      if (small) shrunk(p.drawing, fails, {}, renders);
    }
    Example e = example_of(run, last.drawing, last.got, coverage ? ConsistentRule::lb : run.rule);
    if (e.pixels.empty() && !e.got.rgb.empty()) add_measured(e, last, run.rule);
    e.from_case = p.case_id, e.renders = renders, e.shrunk = small, e.alone = alone;
    f.examples.push_back(std::move(e));
  }
}

}  // namespace farop::conformance
