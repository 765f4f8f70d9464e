// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading/reflection.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace farop {
namespace {

Material material(double ka, double kd, double ks, double shine) {
  Material m;
  m.color = {0.8, 0.4, 0.2};
  m.ka = ka;
  m.kd = kd;
  m.ks = ks;
  m.shine = shine;
  return m;
}

const V3d k_origin(0, 0, 0), k_up(0, 0, 1);

TEST(Reflection, WithoutLightsOnlyTheAmbientTermIsLeft) {
  const Rgb c = reflect(material(0.3, 0.5, 0.5, 10), {}, k_origin, k_up, V3d(0, 0, 5));
  EXPECT_DOUBLE_EQ(c.r, 0.24);
  EXPECT_DOUBLE_EQ(c.g, 0.12);
  EXPECT_DOUBLE_EQ(c.b, 0.06);
}

TEST(Reflection, DiffuseTermFollowsTheCosine) {
  for (const double degrees : {0.0, 30.0, 60.0, 89.0}) {
    const double a = degrees * std::numbers::pi / 180;
    const LightSource light{{10 * std::sin(a), 0, 10 * std::cos(a)}, {0.5, 1, 1}};
    const Rgb c = reflect(material(0, 0.5, 0, 0), {&light, 1}, k_origin, k_up, V3d(0, 0, 5));
    EXPECT_NEAR(c.r, 0.5 * 0.8 * 0.5 * std::cos(a), 1e-12);
    EXPECT_NEAR(c.g, 0.4 * 0.5 * std::cos(a), 1e-12);
  }
}

TEST(Reflection, HighlightHasTheColourOfTheLightNotOfTheSurface) {
  // Light and eye at 45 degrees on opposite sides: R.V = 1.
  const LightSource light{{-3, 0, 3}, {0.25, 0.5, 0.75}};
  const Rgb c = reflect(material(0, 0, 0.4, 20), {&light, 1}, k_origin, k_up, V3d(7, 0, 7));
  EXPECT_NEAR(c.r, 0.4 * 0.25, 1e-12);
  EXPECT_NEAR(c.g, 0.4 * 0.5, 1e-12);
  EXPECT_NEAR(c.b, 0.4 * 0.75, 1e-12);
}

TEST(Reflection, HighlightFallsWithThePowerOfTheCosine) {
  const LightSource light{{0, 0, 3}, {1, 1, 1}};
  const double a = 20 * std::numbers::pi / 180;
  const Rgb c =
      reflect(material(0, 0, 1, 8), {&light, 1}, k_origin, k_up, V3d(5 * std::sin(a), 0, 5 * std::cos(a)));
  EXPECT_NEAR(c.g, std::pow(std::cos(a), 8), 1e-12);
}

TEST(Reflection, ALightBehindTheSurfaceAddsNothingEvenAHighlight) {
  const LightSource light{{0, 1, -3}, {1, 1, 1}};
  const Rgb c = reflect(material(0.1, 1, 1, 1), {&light, 1}, k_origin, k_up, V3d(0, 0, 5));
  EXPECT_DOUBLE_EQ(c.r, 0.08);
}

TEST(Reflection, AReflectionAwayFromTheEyeCountsAsZero) {
  const LightSource light{{-3, 0, 1}, {1, 1, 1}};
  const Rgb c = reflect(material(0, 0, 1, 3), {&light, 1}, k_origin, k_up, V3d(-5, 0, 0.01));
  EXPECT_DOUBLE_EQ(c.r, 0);
}

TEST(Reflection, SumsLightsAndClampsOnceAtTheEnd) {
  const std::array<LightSource, 3> lights{LightSource{{0, 0, 1}, {0.6, 0.6, 0.6}},
                                          LightSource{{0, 0, 2}, {0.6, 0.6, 0.6}},
                                          LightSource{{0, 0, 3}, {9, 9, 9}}};
  const std::span<const LightSource> all(lights);
  EXPECT_NEAR(reflect(material(0, 1, 0, 0), all.first(2), k_origin, k_up, V3d(0, 0, 5)).r, 2 * 0.6 * 0.8,
              1e-12);
  EXPECT_DOUBLE_EQ(reflect(material(0, 1, 0, 0), all, k_origin, k_up, V3d(0, 0, 5)).r, 1);
}

TEST(Reflection, ALightAtThePointItselfAddsNothing) {
  const LightSource light{k_origin, {1, 1, 1}};
  const Rgb c = reflect(material(0.5, 1, 1, 5), {&light, 1}, k_origin, k_up, k_origin);
  EXPECT_DOUBLE_EQ(c.r, 0.4);
}

TEST(Material, OpacityIsOneMinusTransmittanceWithinItsRange) {
  Material m;
  m.transmittance = 0.75;
  EXPECT_EQ(m.opacity(), (Rgb{0.25, 0.25, 0.25}));
  m.transmittance = 7;
  EXPECT_EQ(m.opacity(), (Rgb{0, 0, 0}));
  m.transmittance = -1;
  EXPECT_EQ(m.opacity(), (Rgb{1, 1, 1}));
}

}  // namespace
}  // namespace farop
