// SPDX-License-Identifier: GPL-3.0-or-later
// Instruction sets, for tests that every one of them gives the same.
#pragma once

#include <hwy/targets.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace farop::test {

/// Has only one instruction set be used while it lives.
class VectorTarget {
 public:
  explicit VectorTarget(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ~VectorTarget() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  VectorTarget(const VectorTarget&) = delete;
  VectorTarget& operator=(const VectorTarget&) = delete;
};

/// Those that this machine has.
inline std::vector<std::int64_t> vector_targets() {
  std::vector<std::int64_t> all;
  for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) all.push_back(rest & -rest);
  return all;
}

}  // namespace farop::test
