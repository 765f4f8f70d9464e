// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sample_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace farop {
namespace {

TEST(SampleStatistics, MedianIsTheMiddleOne) {
  EXPECT_EQ(median({3}), 3);
  EXPECT_EQ(median({5, 1, 3}), 3);
  EXPECT_EQ(median({4, 1, 3, 10}), 3.5);
}

TEST(SampleStatistics, RatioIsThatOfNeighboursInTime) {
  // The machine gets slower and slower; b takes twice as long as a at every moment.
  std::vector<double> a, b;
  for (int i = 0; i < 20; ++i) a.push_back(1 + i), b.push_back(2 * (1 + i));
  const Estimate ratio = paired_ratio(a, b);
  EXPECT_DOUBLE_EQ(ratio.value, 2);
  EXPECT_DOUBLE_EQ(ratio.low, 2);
  EXPECT_DOUBLE_EQ(ratio.high, 2);
}

// 95 of 100 intervals should hold the truth; fewer than 85 would be a fault, so would 100 very wide ones.
TEST(SampleStatistics, IntervalsHoldTheTruthAsOftenAsTheySay) {
  std::mt19937_64 random(5);
  std::lognormal_distribution<double> noise(0, 0.1);
  int held = 0;
  double width = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> a, b;
    for (int i = 0; i < 25; ++i) a.push_back(noise(random)), b.push_back(1.5 * noise(random));
    const Estimate ratio = paired_ratio(a, b);
    held += ratio.contains(1.5) ? 1 : 0;
    width += (ratio.high - ratio.low) / 100;
    EXPECT_LE(ratio.low, ratio.value);
    EXPECT_LE(ratio.value, ratio.high);
  }
  EXPECT_GE(held, 85);
  EXPECT_LT(width, 0.3);
}

TEST(SampleStatistics, GrowthIsTheExponent) {
  std::mt19937_64 random(6);
  std::lognormal_distribution<double> noise(0, 0.02);
  const std::vector<double> x = {100, 400, 1600, 6400};
  std::vector<std::vector<double>> linear, square;
  for (const double v : x) {
    linear.emplace_back(), square.emplace_back();
    for (int i = 0; i < 11; ++i) {
      linear.back().push_back(3e-6 * v * noise(random));
      square.back().push_back(1e-9 * v * v * noise(random));
    }
  }
  const Estimate one = growth_exponent(x, linear), two = growth_exponent(x, square);
  EXPECT_NEAR(one.value, 1, 0.03);
  EXPECT_NEAR(two.value, 2, 0.03);
  EXPECT_TRUE(one.contains(one.value) && !one.contains(1.2) && !two.contains(1.8));
}

}  // namespace
}  // namespace farop
