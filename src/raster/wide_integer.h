// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace farop {

/// For the few products that 64 bits cannot hold. gcc and clang have it on all 64-bit machines, ISO C++ does
/// not.
__extension__ using Int128 = __int128;

/// Quotient rounded towards minus infinity; b > 0.
template <class Integer>
constexpr Integer floor_div(Integer a, Integer b) {
  const Integer q = a / b;
  return a % b < 0 ? q - 1 : q;
}

}  // namespace farop
