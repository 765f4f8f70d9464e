// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdlib>

namespace farop::test {

/// How many random cases: `usual`, or `many` when the environment has FAROP_LONG_TESTS=1 (hours, for a
/// release).
inline std::uint64_t repetitions(std::uint64_t usual, std::uint64_t many) {
  const char* const value = std::getenv("FAROP_LONG_TESTS");
  return value != nullptr && *value == '1' ? many : usual;
}

}  // namespace farop::test
