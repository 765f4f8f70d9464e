// SPDX-License-Identifier: GPL-3.0-or-later
// What drawing and judging cases has brought to light.
#pragma once

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
  double worst_color = 0;

  void add(Outcome other);
};

}  // namespace farop::conformance
