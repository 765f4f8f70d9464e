// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace farop::conformance {

/// For products that 64 bits cannot hold. gcc and clang have it on all 64-bit machines, ISO C++ does not.
__extension__ using Wide = __int128;

/// Quotient rounded down; b > 0.
constexpr Wide floor_quotient(Wide a, Wide b) {
  const Wide q = a / b;
  return a % b < 0 ? q - 1 : q;
}
constexpr Wide ceil_quotient(Wide a, Wide b) {
  return -floor_quotient(-a, b);
}

}  // namespace farop::conformance
