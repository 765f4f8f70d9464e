// SPDX-License-Identifier: GPL-3.0-or-later
// What drawing and judging cases has brought to light.
#pragma once

#include <optional>
#include <vector>

#include "conformance/evidence.h"
#include "conformance/problem.h"
#include "conformance/result.h"

namespace farop::conformance {

struct Outcome {
  std::vector<Problem> problems;
  std::vector<Evidence> evidence;
  DepthStatistics depths;
  ColorStatistics colors;
  /// Of scenes, whose colours are too alike to tell a wrong one from another polygon's.
  ColorStatistics scene_colors;
  std::optional<double> worst_depth, worst_color;  ///< nothing: none was measured
  std::vector<PerfResult> perf;

  void add(Outcome other);
};

}  // namespace farop::conformance
