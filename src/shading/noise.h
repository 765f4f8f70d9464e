// SPDX-License-Identifier: GPL-3.0-or-later
// SIPP's lattice noise, and the generator that its tables come from.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>

#include "core/math.h"

namespace farop {

/// The 48-bit linear congruential generator of POSIX drand48, as glibc starts it without a seed: X = 0, then
/// X <- 0x5DEECE66D X + 11 mod 2^48. SIPP fills its noise table and jitters its shadows from one such
/// sequence, so who draws first matters; hence an object that both can share.
class Rand48 {
 public:
  /// The next number, X / 2^48: 0 <= u < 1.
  double next();

 private:
  std::uint64_t state_ = 0;
};

/// A random value at every point of a lattice of whole numbers, between them a quadratic B-spline: smooth,
/// its gradient continuous. The values are hashed from 512 numbers. Any coordinates: those beyond the range
/// of 32-bit integers are mirrored back into it, those that are no number count as 0.
class NoiseTable {
 public:
  /// Draws 512 numbers 0 <= u < 1.
  explicit NoiseTable(const std::function<double()>& uniform);

  /// -1 < noise < 1.
  double noise(const V3d& p) const;
  /// SIPP's Dnoise: the derivatives of noise() by x, y, z.
  V3d gradient(const V3d& p) const;
  /// Sum over k = 0 .. octaves - 1 of noise(2^k p) / 2^k.
  double turbulence(const V3d& p, int octaves) const;

 private:
  double weighted_sum(const std::array<std::array<int, 3>, 3>& hashes, const std::array<double, 3>& wx,
                      const std::array<double, 3>& wy, const std::array<double, 3>& wz) const;

  std::array<double, 512> values_{};  ///< -1 <= value < 1
};

/// The table of a fresh Rand48, made on first use: what a SIPP program sees that has drawn no shadow before.
const std::shared_ptr<const NoiseTable>& standard_noise();

}  // namespace farop
