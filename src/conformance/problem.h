// SPDX-License-Identifier: GPL-3.0-or-later
// What one case found, before causes are named and problems of one cause become one finding.
#pragma once

#include <string>
#include <vector>

#include "conformance/corpus.h"
#include "conformance/judge.h"
#include "conformance/subject.h"

namespace farop::conformance {

/// A measured depth: the exact one, and the interval in which the rasterizer's lies.
struct MeasuredDepth {
  int x = 0, y = 0;
  std::uint32_t owner = 0;
  std::int64_t farthest_win = 0;  ///< k_w: the depth is in k_w .. k_w + 1
  std::int64_t whole = 0;         ///< the depth, where it is a whole number
};

struct Problem {
  std::string case_id, verdict, detail;
  Severity severity = Severity::error;
  std::string message, hint;
  Drawing drawing;  ///< as given
  std::vector<WrongSample> wrong;
  std::vector<MeasuredDepth> measured;  ///< wrong ones, where depth was measured
  std::uint64_t count = 0;
  std::vector<std::string> shown_by;  ///< where it is not one case: all that show it
  std::uint64_t explained = 0;        ///< of `count`, where `shown_by` is filled
  /// What it is where depths are wrong at small resolutions, too; empty: the same.
  std::string else_verdict, else_message, else_hint;
  Framebuffer got;
  std::vector<std::string> trace;
  std::optional<std::uint32_t> polygon;
};

/// Depth order at samples where it is forced, in the words of simple programs.
struct DepthStatistics {
  std::uint64_t decided = 0, right = 0;
  std::uint64_t last_wins = 0, farthest_wins = 0, depth_always_written = 0, mean_depth_wins = 0;
  std::uint64_t whole_span_colored = 0;
  /// Wrong samples above a right one, and how many of them show what is right below.
  std::uint64_t wrong_begins = 0, kept_from_below = 0;

  void add(const Expectation& expected, const Framebuffer& picture);
  void add(const DepthStatistics& other);
  /// "depth.none" ...; message and hint.
  struct Name {
    std::string verdict, message, hint;
  };
  Name name() const;
};

/// How wrong colours of right owners come about: how many of them each explanation fits.
struct ColorStatistics {
  std::uint64_t wrong = 0, start_sample = 0, channels = 0, out_of_range = 0, small = 0;
  std::vector<std::uint64_t> flat;  ///< by vertex

  void add(const Expectation& expected, const std::vector<WrongSample>& samples);
  void add(const ColorStatistics& other);
  DepthStatistics::Name name() const;
};

/// The explanation that fits wrong depths best.
DepthStatistics::Name name_depths(const Expectation& expected, const std::vector<MeasuredDepth>& wrong);

}  // namespace farop::conformance
