// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/outcome.h"

#include <algorithm>
#include <utility>

namespace farop::conformance {

void Outcome::add(Outcome other) {
  depths.add(other.depths), colors.add(other.colors), scene_colors.add(other.scene_colors);
  worst_depth = std::max(worst_depth, other.worst_depth);
  worst_color = std::max(worst_color, other.worst_color);
  for (Problem& p : other.problems) problems.push_back(std::move(p));
  for (PerfResult& r : other.perf) perf.push_back(std::move(r));
  for (Evidence& e : other.evidence) evidence.push_back(std::move(e));
}

}  // namespace farop::conformance
