// SPDX-License-Identifier: GPL-3.0-or-later
// What tests of the tiled path share: instruction sets, and where two pictures differ.
#pragma once

#include <hwy/targets.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/framebuffer.h"

namespace farop::test {

/// Has only one instruction set be used while it lives.
class OnlyTarget {
 public:
  explicit OnlyTarget(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ~OnlyTarget() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  OnlyTarget(const OnlyTarget&) = delete;
  OnlyTarget& operator=(const OnlyTarget&) = delete;
};

/// Those that this machine has, one lane at a time included.
inline std::vector<std::int64_t> targets() {
  std::vector<std::int64_t> all;
  for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) all.push_back(rest & -rest);
  if (std::find(all.begin(), all.end(), HWY_SCALAR) == all.end()) all.push_back(HWY_SCALAR);
  return all;
}

/// The first difference, or nothing. Both pictures have depths.
inline std::string difference(const Framebuffer& a, const Framebuffer& b) {
  if (a.width != b.width || a.height != b.height || a.depth.size() != b.depth.size()) return "size";
  const auto width = static_cast<std::size_t>(a.width);
  for (std::size_t i = 0; i < a.depth.size(); ++i) {
    const std::string where = " at " + std::to_string(i % width) + ' ' + std::to_string(i / width);
    if (a.depth[i] != b.depth[i])
      return "depth " + std::to_string(a.depth[i]) + ", " + std::to_string(b.depth[i]) + where;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      if (a.rgb[c] == b.rgb[c]) continue;
      return "colour " + std::to_string(a.rgb[c]) + ", " + std::to_string(b.rgb[c]) + where;
    }
  }
  return "";
}

}  // namespace farop::test
