// SPDX-License-Identifier: GPL-3.0-or-later
// x^n of highlights, from additions, multiplications and one division in a fixed order: the same bits on
// every machine, in every vector width (geometry/batched/kernels.cpp has the same steps for vectors),
// whatever library is installed.
//
// Source: log2(x) = k + log2(m), sqrt(1/2) <= m < sqrt(2), by the series of 2 artanh((m-1)/(m+1)); 2^t by the
// series of the exponential function around the nearest whole number.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace farop {
namespace power {

constexpr std::uint64_t k_one = 0x3FF0000000000000u;        ///< bits of 1
constexpr std::uint64_t k_root_half = 0x3FE6A09E667F3BCDu;  ///< bits of sqrt(1/2)
constexpr std::uint64_t k_mantissa = 0x000FFFFFFFFFFFFFu;
constexpr std::uint64_t k_two_52 = 0x4330000000000000u;  ///< bits of 2^52: + k < 2^52 are those of 2^52 + k
constexpr double k_smallest = 0x1p-1022;
constexpr double k_round = 0x1.8p52;  ///< added and taken off again: the nearest whole number
constexpr double k_least = -1022, k_most = 1023;

/// Of z^j, z the square of (m-1)/(m+1): 2 / ((2j+1) ln 2). What is left out is below 2^-55.
constexpr std::array<double, 10> k_log{
    2.8853900817779268, 0.9617966939259756,  0.5770780163555853,  0.4121985831111324,  0.3205988979753252,
    0.2623081892525388, 0.22195308321368667, 0.19235933878519512, 0.16972882833987804, 0.15186263588304877};
/// Of f^j, |f| <= 1/2: (ln 2)^j / j!. What is left out is below 2^-57.
constexpr std::array<double, 14> k_exp{1.0,
                                       0.6931471805599453,
                                       0.24022650695910072,
                                       0.05550410866482158,
                                       0.009618129107628477,
                                       0.0013333558146428443,
                                       0.0001540353039338161,
                                       1.5252733804059841e-05,
                                       1.321548679014431e-06,
                                       1.01780860092397e-07,
                                       7.054911620801123e-09,
                                       4.4455382718708116e-10,
                                       2.5678435993488206e-11,
                                       1.3691488853904128e-12};

}  // namespace power

/// x^n for 0 <= x, 0 <= n, both finite. x^0 = 1; 0^n = 0 for n > 0. What is below 2^-1022 is 0, as is a
/// power of anything below that (NaN included); powers from 2^1023 on are about 2^1023. The relative error
/// is below 2^-50 (1 + log2(1 / x^n)): nothing that a colour of 16 bits can tell from the exact value.
inline double highlight_power(double x, double n) {
  using namespace power;
  if (n == 0) return 1;
  if (!(x >= k_smallest)) return 0;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x) + (k_one - k_root_half);
  const double m = std::bit_cast<double>((bits & k_mantissa) + k_root_half);
  const double k = std::bit_cast<double>((bits >> 52) | k_two_52) - (std::bit_cast<double>(k_two_52) + 1023);
  const double s = (m - 1) / (m + 1);
  // Both series as one of even and one of odd terms, which do not wait for each other.
  const double z = s * s, zz = z * z;
  const double log_even = k_log[0] + zz * (k_log[2] + zz * (k_log[4] + zz * (k_log[6] + zz * k_log[8])));
  const double log_odd = k_log[1] + zz * (k_log[3] + zz * (k_log[5] + zz * (k_log[7] + zz * k_log[9])));
  const double t = n * (k + s * (log_even + z * log_odd));
  if (!(t >= k_least)) return 0;
  const double limited = t < k_most ? t : k_most;
  const double shifted = limited + k_round;
  const double f = limited - (shifted - k_round);
  const double ff = f * f;
  const double exp_even =
      k_exp[0] +
      ff * (k_exp[2] +
            ff * (k_exp[4] + ff * (k_exp[6] + ff * (k_exp[8] + ff * (k_exp[10] + ff * k_exp[12])))));
  const double exp_odd =
      k_exp[1] +
      ff * (k_exp[3] +
            ff * (k_exp[5] + ff * (k_exp[7] + ff * (k_exp[9] + ff * (k_exp[11] + ff * k_exp[13])))));
  const double scale = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);
  return (exp_even + f * exp_odd) * scale;
}

}  // namespace farop
