// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/run.h"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>

namespace farop::conformance {
namespace {

Problem problem_of(const Case& c, const SubjectFailure& f, const Drawing& drawing) {
  Problem p;
  p.case_id = c.id(), p.verdict = f.verdict, p.message = f.message, p.hint = f.hint;
  p.severity = f.warning ? Severity::warning : Severity::error;
  p.trace = f.trace, p.polygon = f.polygon, p.drawing = drawing;
  return p;
}

}  // namespace

Delivered Run::draw(Subject& subject, const Drawing& given) {
  ++renders_;
  Delivered d = subject.draw(given);
  if (d.picture && (d.picture->width != given.frame.x || d.picture->height != given.frame.y)) {
    d.failure =
        SubjectFailure{"abi.size",
                       fmt::format("the picture has {} x {} pixels", d.picture->width, d.picture->height),
                       fmt::format("{} x {} were asked for", given.frame.x, given.frame.y),
                       {},
                       {},
                       false};
    d.picture.reset();
  }
  if (d.picture) *d.picture = transform.undo(*d.picture, maker.background());
  return d;
}

std::optional<Framebuffer> Run::picture_of(const Case& c, Subject& subject, const Drawing& given,
                                           Outcome& out) {
  Delivered d = draw(subject, given);
  for (const SubjectFailure& r : d.remarks) out.problems.push_back(problem_of(c, r, given));
  if (d.failure) {
    out.problems.push_back(problem_of(c, *d.failure, given));
    return std::nullopt;
  }
  return std::move(d.picture);
}

JudgeOptions Run::judge_options(const Case& c) const {
  return {maker.background(), skip_boundary, c.free_interpolation, options.precision};
}

std::vector<TestPolygon> Run::pieces_of(const Resolution& frame, const TestPolygon& polygon) const {
  return maker.as_given({frame, {polygon}}).polygons;
}

bool near(const Color& a, const Color& b) {
  return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1 && std::abs(a[2] - b[2]) <= 1;
}

}  // namespace farop::conformance
