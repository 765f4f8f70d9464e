// SPDX-License-Identifier: GPL-3.0-or-later
// What a test does less of under sanitizers, where everything takes several times as long: the optimised
// build runs it whole.
#pragma once

namespace farop::test {

#ifdef __SANITIZE_ADDRESS__
constexpr bool k_address_sanitizer = true;
#else
constexpr bool k_address_sanitizer = false;
#endif

/// How many random cases of `all` to try in this build.
constexpr int rounds(int all) {
  return k_address_sanitizer ? (all + 4) / 5 : all;
}

}  // namespace farop::test
