// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

namespace farop {
namespace {

TEST(Rand48, StartsLikeAnUnseededDrand48) {
  // By hand: X1 = 11; X2 = 0x5DEECE66D * 11 + 11 = 277363943098 < 2^48;
  // X3 = 0x5DEECE66D * X2 + 11 mod 2^48 = 11718085204285.
  Rand48 r;
  EXPECT_EQ(r.next(), std::ldexp(11, -48));
  EXPECT_EQ(r.next(), std::ldexp(277363943098.0, -48));
  EXPECT_EQ(r.next(), std::ldexp(11718085204285.0, -48));
}

TEST(Rand48, FollowsTheCLibrarysSequence) {
  // Bring the C library's generator to X = 0, its state in a program that has not seeded it.
  unsigned short zero[3] = {0, 0, 0};
  Rand48 r;
  for (int i = 0; i < 2000; ++i) ASSERT_EQ(r.next(), erand48(zero)) << i;
}

TEST(Noise, IsTheTableAtTheMiddleOfASpline) {
  // A table that is 1 at one place and 0 elsewhere; the lattice point 0 0 0 hashes to 0 + 0 + 0.
  int n = 0;
  const NoiseTable table([&] { return n++ == 0 ? 1.0 : 0.5; });
  // At -0.5 per axis the lattice points are -1, 0, 1 with weights 1/8, 3/4, 1/8.
  EXPECT_NEAR(table.noise(V3d(-0.5, -0.5, -0.5)), 0.75 * 0.75 * 0.75, 0.01);
}

TEST(Noise, OfAConstantTableIsThatConstant) {
  const NoiseTable table([] { return 0.75; });
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1000, 1000);
  for (int i = 0; i < 1000; ++i) {
    const V3d p(coordinate(random), coordinate(random), coordinate(random));
    EXPECT_NEAR(table.noise(p), 0.5, 1e-12);
    EXPECT_NEAR(table.gradient(p).length(), 0, 1e-12);
  }
}

TEST(Noise, StandardTableGivesTheseValues) {
  // Written out from the definition with the table's numbers themselves.
  double pts[512];
  Rand48 r;
  for (double& p : pts) p = 2 * r.next() - 1;
  const auto g = [&](int i, int j, int k) {
    const auto h = [](int n, int t) {
      const double v = t * 0.6180339;
      return static_cast<int>(std::floor(n * (v - std::floor(v))));
    };
    return pts[(h(173, i) + h(263, j) + h(337, k)) % 512];
  };
  for (const V3d& p : {V3d(0.25, 0.5, 0.75), V3d(-3.5, 17.125, 100.625), V3d(-0.001, -9, 4)}) {
    double sum = 0;
    const V3d base(std::floor(p.x), std::floor(p.y), std::floor(p.z));
    const V3d f = p - base;
    const auto w = [](int n, double t) {
      return n == 0 ? 0.5 - t + t * t / 2 : n == 1 ? 0.5 + t - t * t : t * t / 2;
    };
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        for (int c = 0; c < 3; ++c)
          sum += w(a, f.x) * w(b, f.y) * w(c, f.z) *
                 g(static_cast<int>(base.x) + a, static_cast<int>(base.y) + b, static_cast<int>(base.z) + c);
    EXPECT_NEAR(standard_noise()->noise(p), sum, 1e-12);
  }
}

TEST(Noise, StaysWithinOneAndUsesItsRange) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(-500, 500);
  double low = 0, high = 0;
  for (int i = 0; i < 200000; ++i) {
    const double v = standard_noise()->noise(V3d(coordinate(random), coordinate(random), coordinate(random)));
    low = std::min(low, v), high = std::max(high, v);
  }
  EXPECT_GT(low, -1);
  EXPECT_LT(high, 1);
  EXPECT_LT(low, -0.5);
  EXPECT_GT(high, 0.5);
}

TEST(Noise, GradientIsThatOfTheNoise) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-50, 50);
  constexpr double step = 1e-5;
  for (int i = 0; i < 2000; ++i) {
    const V3d p(coordinate(random), coordinate(random), coordinate(random));
    const V3d gradient = standard_noise()->gradient(p);
    for (int axis = 0; axis < 3; ++axis) {
      V3d before = p, after = p;
      before[axis] -= step, after[axis] += step;
      const double difference =
          (standard_noise()->noise(after) - standard_noise()->noise(before)) / (2 * step);
      ASSERT_NEAR(gradient[axis], difference, 1e-4) << p << axis;
    }
  }
}

TEST(Noise, IsSmoothAcrossTheLattice) {
  for (const double at : {-7.0, -1.0, 0.0, 1.0, 12.0}) {
    const double eps = 1e-9;
    for (int axis = 0; axis < 3; ++axis) {
      V3d before(0.3, 0.6, 0.9), after(0.3, 0.6, 0.9);
      before[axis] = at - eps, after[axis] = at + eps;
      EXPECT_NEAR(standard_noise()->noise(before), standard_noise()->noise(after), 1e-7);
      EXPECT_NEAR((standard_noise()->gradient(before) - standard_noise()->gradient(after)).length(), 0, 1e-7);
    }
  }
}

TEST(Noise, TurbulenceAddsOctavesOfHalfTheSize) {
  const V3d p(0.7, -1.9, 3.3);
  const NoiseTable& t = *standard_noise();
  EXPECT_EQ(t.turbulence(p, 0), 0);
  EXPECT_EQ(t.turbulence(p, 1), t.noise(p));
  EXPECT_NEAR(t.turbulence(p, 3), t.noise(p) + t.noise(p * 2.0) / 2 + t.noise(p * 4.0) / 4, 1e-15);
}

TEST(Noise, FoldsCoordinatesThatNoIntegerHolds) {
  const NoiseTable& t = *standard_noise();
  constexpr double limit = 2147483648.0;
  EXPECT_EQ(t.noise(V3d(limit + 5.25, 1, 1)), t.noise(V3d(limit - 5.25, 1, 1)));
  EXPECT_EQ(t.noise(V3d(-limit - 5.25, 1, 1)), t.noise(V3d(-limit + 5.25, 1, 1)));
  EXPECT_EQ(t.noise(V3d(4 * limit + 7.5, 1, 1)), t.noise(V3d(7.5, 1, 1)));
  for (const double v : {1e300, -1e300, std::numeric_limits<double>::infinity(),
                         std::numeric_limits<double>::quiet_NaN(), limit, -limit, limit - 0.5}) {
    for (int axis = 0; axis < 3; ++axis) {
      V3d p(0.5, 0.5, 0.5);
      p[axis] = v;
      EXPECT_TRUE(std::abs(t.noise(p)) < 1) << v;
      EXPECT_TRUE(std::isfinite(t.gradient(p).length())) << v;
      EXPECT_TRUE(std::isfinite(t.turbulence(p, 2000000000))) << v;
    }
  }
}

}  // namespace
}  // namespace farop
