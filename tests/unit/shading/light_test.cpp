// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace farop {
namespace {

double cosine(double degrees) {
  return std::cos(degrees * std::numbers::pi / 180);
}

/// A spot at (0,0,10) that shines down, and the point of z = 0 that it sees at an angle.
LightSource spot(LightKind kind, double opening_degrees) {
  return {V3d(0, 0, 10), {1, 1, 1}, kind, V3d(0, 0, -1), cosine(opening_degrees / 2)};
}
V3d seen_at(double degrees) {
  return {10 * std::tan(degrees * std::numbers::pi / 180), 0, 0};
}

class HalfShadow : public LightShadow {
 public:
  double unshadowed(const V3d& point) const override { return point.x > 0 ? 0.5 : 0; }
};

TEST(Illuminate, APointLightReachesEverythingAlike) {
  const LightSource light{V3d(0, 3, 4), {1, 1, 1}};
  const auto [to_light, fraction] = illuminate(light, V3d(0, 0, 0));
  EXPECT_EQ(fraction, 1);
  EXPECT_NEAR((to_light - V3d(0, 0.6, 0.8)).length(), 0, 1e-15);
  EXPECT_EQ(illuminate(light, V3d(1e9, 0, 0)).fraction, 1);
  EXPECT_EQ(illuminate(light, light.position).to_light, V3d(0, 0, 0));
}

TEST(Illuminate, ADirectionalLightShinesTheSameWayEverywhere) {
  const LightSource light{V3d(0, 0.6, 0.8), {1, 1, 1}, LightKind::directional};
  for (const V3d& p : {V3d(0, 0, 0), V3d(5, -7, 1e6)}) {
    EXPECT_EQ(illuminate(light, p).to_light, V3d(0, 0.6, 0.8));
    EXPECT_EQ(illuminate(light, p).fraction, 1);
  }
}

struct ConeRow {
  double opening, angle, sharp, soft;  ///< degrees, fractions
};

// soft = 1/2 + 1/2 cos(pi (1 - cos angle) / (1 - cos(opening / 2))).
TEST(Illuminate, SpotsHaveTheseCones) {
  constexpr ConeRow rows[] = {
      {60, 0, 1, 1},         {60, 5, 1, 0.998011},  {60, 10, 1, 0.968606},  {60, 15, 1, 0.848708},
      {60, 20, 1, 0.577999}, {60, 25, 1, 0.206962}, {60, 29.99, 1, 1e-6},   {60, 30.01, 0, 0},
      {60, 80, 0, 0},        {20, 5, 1, 0.853024},  {20, 9.99, 1, 1e-5},    {20, 10.01, 0, 0},
      {180, 45, 1, 0.80285}, {180, 60, 1, 0.5},     {180, 89, 1, 0.000751}, {300, 80, 1, 0.589304},
  };
  for (const ConeRow& row : rows) {
    const auto fraction = [&](LightKind kind) {
      return illuminate(spot(kind, row.opening), seen_at(row.angle)).fraction;
    };
    EXPECT_EQ(fraction(LightKind::spot_sharp), row.sharp) << row.opening << ' ' << row.angle;
    EXPECT_NEAR(fraction(LightKind::spot_soft), row.soft, 1e-6) << row.opening << ' ' << row.angle;
  }
}

TEST(Illuminate, BehindASpotOnlyWideSharpOnesShine) {
  const V3d behind(3, 0, 11);
  EXPECT_EQ(illuminate(spot(LightKind::spot_sharp, 170), behind).fraction, 0);
  EXPECT_EQ(illuminate(spot(LightKind::spot_sharp, 300), behind).fraction, 1);
  EXPECT_EQ(illuminate(spot(LightKind::spot_soft, 300), behind).fraction, 0);
}

TEST(Illuminate, AConeWithoutWidthIsNoDivisionByZero) {
  EXPECT_EQ(illuminate(spot(LightKind::spot_soft, 0), V3d(0, 0, 0)).fraction, 1);
  EXPECT_EQ(illuminate(spot(LightKind::spot_soft, 0), V3d(0.01, 0, 0)).fraction, 0);
}

TEST(Illuminate, ShadowsTakeTheirShareOfWhatTheConeLeaves) {
  LightSource light = spot(LightKind::spot_soft, 60);
  light.shadow = std::make_shared<const HalfShadow>();
  EXPECT_NEAR(illuminate(light, seen_at(20)).fraction, 0.5 * 0.577999, 1e-6);
  EXPECT_EQ(illuminate(light, V3d(-1, 0, 0)).fraction, 0);
  EXPECT_EQ(illuminate(light, seen_at(40)).fraction, 0);
}

}  // namespace
}  // namespace farop
