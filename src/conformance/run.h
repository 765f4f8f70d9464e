// SPDX-License-Identifier: GPL-3.0-or-later
// What all cases of a run share: what is drawn with, and what is known of it so far. For src/conformance.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "conformance/check.h"
#include "conformance/outcome.h"
#include "conformance/transform.h"

namespace farop::conformance {

/// draw() and picture_of() may be called by several threads, each with a life of its own. What is known
/// changes between families only.
class Run {
 public:
  /// Both must outlive it.
  Run(const SubjectMaker& subjects, const CheckOptions& how) : maker(subjects), options(how) {}

  const SubjectMaker& maker;
  const CheckOptions& options;

  // What earlier families have shown.
  Transform transform;                       ///< undone in every picture
  ConsistentRule rule = ConsistentRule::lb;  ///< which samples belong to a polygon
  std::optional<FillRule> known_rule;        ///< not consistent, but nearly all follows it
  bool visits_whole_frame = false;           ///< for every polygon: no other time is worth measuring
  bool skip_boundary = false;                ///< no consistent rule: samples on edges are not judged

  /// One picture of the right size, or a failure. Throws Error(surroundings) as Subject::draw() does.
  Delivered draw(Subject& subject, const Drawing& given);
  /// The picture, or nothing after noting the failure. Remarks become problems too.
  std::optional<Framebuffer> picture_of(const Case& c, Subject& subject, const Drawing& given, Outcome& out);
  std::uint64_t renders() const { return renders_; }

  Color background() const { return maker.background(); }
  JudgeOptions judge_options(const Case& c) const;
  /// The polygon as the rasterizer gets it: in one piece, or in triangles.
  std::vector<TestPolygon> pieces_of(const Resolution& frame, const TestPolygon& polygon) const;

 private:
  std::atomic<std::uint64_t> renders_{0};
};

/// Colours that differ by one at most: the same polygon's.
bool near(const Color& a, const Color& b);

}  // namespace farop::conformance
