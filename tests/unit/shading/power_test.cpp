// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading/power.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace farop {
namespace {

TEST(HighlightPower, IsExactWhereThePowerIs) {
  for (const double n : {0.0, 0.5, 1.0, 3.0, 27.8, 1e6}) EXPECT_EQ(highlight_power(1, n), 1) << n;
  for (const double x : {0.0, 1e-310, 0.25, 1.0}) EXPECT_EQ(highlight_power(x, 0), 1) << x;
  EXPECT_EQ(highlight_power(0.5, 10), 0x1p-10);
  EXPECT_EQ(highlight_power(0.25, 0.5), 0.5);
}

TEST(HighlightPower, VanishesWhereNothingCouldBeSeen) {
  EXPECT_EQ(highlight_power(0, 3), 0);
  EXPECT_EQ(highlight_power(0.5, 1100), 0);
  EXPECT_EQ(highlight_power(1e-310, 0.001), 0);
  EXPECT_EQ(highlight_power(std::numeric_limits<double>::quiet_NaN(), 3), 0);
}

TEST(HighlightPower, StaysFiniteWhereRoundingMadeTheCosineLargerThanOne) {
  EXPECT_TRUE(std::isfinite(highlight_power(1 + 1e-15, 1e300)));
  EXPECT_GT(highlight_power(1 + 1e-15, 1e300), 1e300);
  EXPECT_NEAR(highlight_power(1 + 1e-15, 100), 1, 1e-12);
}

TEST(HighlightPower, IsAsNearAsStatedToTheExactValue) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(0, 1);
  for (int i = 0; i < 300'000; ++i) {
    const double x = i % 3 == 0 ? 1 - std::exp2(-50 * u(random)) : u(random);
    const double n = i % 2 == 0 ? std::floor(200 * u(random)) + 1 : std::exp2(20 * u(random) - 5);
    const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(n));
    const double got = highlight_power(x, n);
    if (exact < 0x1p-1021L) continue;
    const double allowed = 0x1p-50 * (1 + std::log2(static_cast<double>(1 / exact)));
    ASSERT_LE(std::abs(static_cast<double>((got - exact) / exact)), allowed) << x << " ^ " << n;
  }
}

}  // namespace
}  // namespace farop
