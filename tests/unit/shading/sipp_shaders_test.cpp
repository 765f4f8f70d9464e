// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading/sipp_shaders.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace farop {
namespace {

const V3d k_up(0, 0, 1);

V3d at_angle(double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  return {std::sin(a), 0, std::cos(a)};
}

/// The origin of a surface in the xy plane, seen from `eye_degrees` off its normal.
ShadingPoint seen_from(double eye_degrees, const V3d& normal = k_up) {
  return {V3d(0, 0, 0), normal, V3d(0, 0, 0), at_angle(eye_degrees)};
}

LightSource directional(double degrees, const Rgb& color = {1, 1, 1}) {
  return {at_angle(degrees), color, LightKind::directional};
}

BasicParameters basic() {
  return {0.25, 0.5, 0.2, {0.8, 0.4, 0.2}, {1, 1, 1}};
}

PhongParameters phong() {
  return {0.25, 0.5, 0.75, 8, {0.8, 0.4, 0.2}, {1, 1, 1}};
}

TEST(SippShaders, WithoutLightTheAmbientTermIsLeft) {
  EXPECT_NEAR(basic_color(basic(), seen_from(10), {}).r, 0.25 * 0.8, 1e-15);
  EXPECT_NEAR(phong_color(phong(), seen_from(10), {}).g, 0.25 * 0.4, 1e-15);
  const StraussParameters strauss{0.25, 0.5, 0, {0.8, 0.4, 0.2}, {1, 1, 1}};
  EXPECT_NEAR(strauss_color(strauss, seen_from(10), {}).g, 0.25 * 0.4 * 0.875, 1e-15);
}

TEST(SippShaders, TheLengthOfTheNormalDoesNotMatter) {
  const LightSource light = directional(40);
  const Rgb once = basic_color(basic(), seen_from(30), {&light, 1});
  const Rgb seven = basic_color(basic(), seen_from(30, V3d(0, 0, 7)), {&light, 1});
  EXPECT_NEAR(once.r, seven.r, 1e-15);
}

// Eye 30 degrees to the left, light 40 to the right: R is 10 degrees away from V.
TEST(SippShaders, BasicFollowsItsFormula) {
  const LightSource light = directional(40, {0.5, 0.5, 1});
  const Rgb c = basic_color(basic(), seen_from(-30), {&light, 1});
  const double n_dot_l = std::cos(40 * std::numbers::pi / 180);
  const double x = std::cos(10 * std::numbers::pi / 180);
  const double highlight = 0.04 * x / (x * x * (0.04 - 1) + 1);
  EXPECT_NEAR(c.r, 0.8 * (0.25 + 0.5 * n_dot_l) + 0.5 * 0.5 * highlight, 1e-14);
  EXPECT_NEAR(c.b, 0.2 * (0.25 + 1.0 * n_dot_l) + 0.5 * 1.0 * highlight, 1e-14);
}

TEST(SippShaders, PhongFollowsItsFormula) {
  const LightSource light = directional(40, {0.5, 0.5, 1});
  const Rgb c = phong_color(phong(), seen_from(-30), {&light, 1});
  const double n_dot_l = std::cos(40 * std::numbers::pi / 180);
  const double highlight = std::pow(std::cos(10 * std::numbers::pi / 180), 8);
  EXPECT_NEAR(c.r, 0.8 * (0.25 + 0.5 * 0.5 * n_dot_l) + 0.75 * 0.5 * highlight, 1e-14);
  EXPECT_NEAR(c.b, 0.2 * (0.25 + 0.5 * 1.0 * n_dot_l) + 0.75 * 1.0 * highlight, 1e-14);
}

TEST(SippShaders, DiffuseAndSpecularSumsAreLimitedEachBeforeTheyAreAdded) {
  const std::array<LightSource, 3> lights{directional(0, {2, 0, 0}), directional(0, {2, 0, 0}),
                                          directional(0, {0, 0.25, 0})};
  PhongParameters p = phong();
  p.color = {0.5, 0.5, 0.5};
  p.ambient = 0.125, p.diffuse = 0.5, p.specular = 0.25;
  const Rgb c = phong_color(p, seen_from(0), lights);
  EXPECT_NEAR(c.r, 0.5 * (0.125 + 0.5 * 1) + 0.25 * 1, 1e-15);
  EXPECT_NEAR(c.g, 0.5 * (0.125 + 0.5 * 0.25) + 0.25 * 0.25, 1e-15);
}

TEST(SippShaders, ALightBehindTheSurfaceStillHasAHighlight) {
  // N.L < 0; R = 2 (N.L) N - L is 20 degrees off V.
  const LightSource light = directional(100);
  const ShadingPoint point = seen_from(-80 - 20);
  const double highlight = std::pow(std::cos(20 * std::numbers::pi / 180), 8);
  const ShadingPoint away = seen_from(-80);
  EXPECT_NEAR(phong_color(phong(), away, {&light, 1}).b, 0.25 * 0.2 + 0.75 * highlight, 1e-14);
  EXPECT_NEAR(phong_color(phong(), point, {&light, 1}).b, 0.25 * 0.2 + 0.75, 1e-14);
  EXPECT_GT(basic_color(basic(), away, {&light, 1}).b, 0.25 * 0.2 + 0.01);
}

TEST(SippShaders, LightsThatHardlyArriveAreSkippedButNotByStrauss) {
  // A soft spot whose cone fades to less than 0.0001 just inside its border.
  LightSource spot{V3d(0, 0, 1), {1000, 1000, 1000}, LightKind::spot_soft, V3d(0, 0, -1), 0.5};
  ShadingPoint point = seen_from(0);
  const double k = 0.502;
  point.position = V3d(std::sqrt(1 / (k * k) - 1), 0, 0);
  const double fraction = illuminate(spot, point.position).fraction;
  ASSERT_GT(fraction, 0);
  ASSERT_LE(fraction, 0.0001);
  EXPECT_EQ(phong_color(phong(), point, {&spot, 1}), phong_color(phong(), point, {}));
  EXPECT_EQ(basic_color(basic(), point, {&spot, 1}), basic_color(basic(), point, {}));
  const StraussParameters strauss{0.25, 0.5, 0.5, {0.8, 0.4, 0.2}, {1, 1, 1}};
  EXPECT_GT(strauss_color(strauss, point, {&spot, 1}).b, strauss_color(strauss, point, {}).b);
  point.position = V3d(100, 0, 0);  // outside the cone
  EXPECT_GT(strauss_color(strauss, point, {&spot, 1}).b, strauss_color(strauss, point, {}).b);
}

// Smoothness 0.5: rd = 0.875, rn = 0.125, h = 6; the terms written out with literals.
TEST(SippShaders, StraussFollowsItsFormula) {
  const StraussParameters p{0.1, 0.5, 0.4, {0.8, 0.4, 0.2}, {1, 1, 1}};
  const LightSource light = directional(60, {0.5, 1, 1});
  const Rgb c = strauss_color(p, seen_from(-50), {&light, 1});
  const double a = 0.5;
  const double g = std::cos(50 * std::numbers::pi / 180);
  const double b = std::cos(10 * std::numbers::pi / 180);
  const auto fr = [](double x) {
    return (1 / std::pow(1 - x - 1.2, 2) - 1 / std::pow(1.2, 2)) /
           (1 / std::pow(1 - 1.2, 2) - 1 / std::pow(1.2, 2));
  };
  const auto ga = [](double x) {
    return (1 / std::pow(1 - 1.031, 2) - 1 / std::pow(1 - x - 1.031, 2)) /
           (1 / std::pow(1 - 1.031, 2) - 1 / std::pow(1.031, 2));
  };
  EXPECT_NEAR(fr(0), 1, 1e-12);
  EXPECT_NEAR(fr(1), 0, 1e-12);
  EXPECT_NEAR(ga(0), 0, 1e-12);
  EXPECT_NEAR(ga(1), 1, 1e-12);
  const double rj = std::min(1.0, 0.125 + 0.225 * fr(a) * ga(a) * ga(g));
  const double rs = rj * std::pow(b, 6);
  const double red = 0.8 * a * 0.875 * (1 - 0.2) + rs * (1 + 0.4 * (1 - fr(a)) * (0.8 - 1));
  EXPECT_NEAR(c.r, 0.5 * red + 0.1 * 0.875 * 0.8, 1e-12);
  const double blue = 0.2 * a * 0.875 * (1 - 0.2) + rs * (1 + 0.4 * (1 - fr(a)) * (0.2 - 1));
  EXPECT_NEAR(c.b, 1.0 * blue + 0.1 * 0.875 * 0.2, 1e-12);
}

TEST(SippShaders, AStraussMirrorReflectsInOneDirectionOnly) {
  const StraussParameters mirror{0.5, 1, 0, {0.8, 0.4, 0.2}, {1, 1, 1}};
  const LightSource light = directional(0);
  EXPECT_NEAR(strauss_color(mirror, seen_from(0), {&light, 1}).b, 1, 1e-12);
  EXPECT_NEAR(strauss_color(mirror, seen_from(5), {&light, 1}).b, 0, 1e-12);
}

TEST(SippShaders, NoAngleGivesAColourOutOfRange) {
  const ShadingFrame frame{{directional(35, {2, 1, 0.5}), directional(-110, {1, 1, 1})}, M44d()};
  for (const double c3 : {0.0, 0.01, 0.5, 1.0, 3.0}) {
    for (double eye = -180; eye <= 180; eye += 0.5) {
      BasicParameters b = basic();
      b.c3 = c3;
      StraussParameters s{0.3, std::min(1.0, c3), 0.7, {0.9, 0.5, 0.1}, {1, 1, 1}};
      for (const Rgb& c : {BasicShader(b).shade(seen_from(eye), frame).color,
                           StraussShader(s).shade(seen_from(eye), frame).color,
                           PhongShader(phong()).shade(seen_from(eye), frame).color}) {
        ASSERT_TRUE(c.r >= 0 && c.r <= 1 && c.g >= 0 && c.g <= 1 && c.b >= 0 && c.b <= 1) << eye << ' ' << c3;
      }
    }
  }
}

TEST(SippShaders, ComputeTheSameInEverySpace) {
  M44d to_other;
  to_other.rotate(V3d(0.3, -1.1, 2.0));
  M44d mirror;
  mirror.scale(V3d(1, 1, -1));  // eye space is left-handed
  to_other = to_other * mirror;
  M44d moved = to_other;
  moved[3][0] = 4, moved[3][1] = -3, moved[3][2] = 9;
  const auto turn = [&](const V3d& v) {
    V3d out;
    to_other.multDirMatrix(v, out);
    return out;
  };
  const ShadingPoint point{V3d(0.5, 0.25, 1), V3d(1, 2, 5), V3d(0, 0, 0), V3d(0, 3, 4).normalized()};
  const std::array<LightSource, 2> lights{
      directional(20),
      LightSource{V3d(1, 2, 8), {1, 1, 1}, LightKind::spot_soft, V3d(0, -0.2, -1).normalized(), 0.5}};
  ShadingPoint other = point;
  other.position = point.position * moved;
  other.normal = turn(point.normal), other.to_eye = turn(point.to_eye);
  std::array<LightSource, 2> seen = lights;
  seen[0].position = turn(lights[0].position);
  seen[1].position = lights[1].position * moved, seen[1].axis = turn(lights[1].axis);
  const StraussParameters strauss{0.1, 0.6, 0.4, {0.8, 0.4, 0.2}, {1, 1, 1}};
  EXPECT_NEAR(basic_color(basic(), point, lights).r, basic_color(basic(), other, seen).r, 1e-12);
  EXPECT_NEAR(phong_color(phong(), point, lights).r, phong_color(phong(), other, seen).r, 1e-12);
  EXPECT_NEAR(strauss_color(strauss, point, lights).r, strauss_color(strauss, other, seen).r, 1e-12);
}

TEST(SippShaders, OpacityDecidesWhatIsSeenBehind) {
  BasicParameters p = basic();
  EXPECT_TRUE(BasicShader(p).opaque());
  p.opacity = {1, 1, 0.5};
  EXPECT_FALSE(BasicShader(p).opaque());
  EXPECT_FALSE(BasicShader(p).invisible());
  EXPECT_EQ(BasicShader(p).shade(seen_from(0), {}).opacity, p.opacity);
  p.opacity = {0, 0, 0};
  EXPECT_TRUE(BasicShader(p).invisible());
}

TEST(SippShaders, NffExponentHasTheSameHalfWidthAsC3) {
  EXPECT_NEAR(shine_of_c3(0.2), 34, 0.1);
  EXPECT_DOUBLE_EQ(shine_of_c3(1), 1);
  EXPECT_NEAR(shine_of_c3(1 + 1e-7), 1, 1e-3);
  for (const double c3 : {0.02, 0.1, 0.3, 0.7, 0.99, 1.01}) {
    const double k = c3 * c3;
    const double half = std::pow(0.5, 1 / shine_of_c3(c3));
    EXPECT_NEAR(k * half / (half * half * (k - 1) + 1), 0.5, 1e-9) << c3;
  }
}

TEST(SippShaders, ApproximationKeepsWhatNffCanSay) {
  std::vector<std::string> lost;
  PhongParameters p = phong();
  p.ambient = 0.30;
  p.opacity = {0.75, 0.75, 0.75};
  const Material m = PhongShader(p).approximate(&lost);
  EXPECT_TRUE(lost.empty());
  EXPECT_EQ(m.color, p.color);
  EXPECT_EQ(m.ka, 0.30);
  EXPECT_EQ(m.kd, 0.5);
  EXPECT_EQ(m.ks, 0.75);
  EXPECT_EQ(m.shine, 8);
  EXPECT_EQ(m.transmittance, 0.25);
}

TEST(SippShaders, ApproximationNamesWhatIsLost) {
  std::vector<std::string> lost;
  BasicParameters p = basic();
  p.opacity = {1, 0.5, 0};
  const Material m = BasicShader(p).approximate(&lost);
  EXPECT_EQ(m.kd, 1);
  EXPECT_EQ(m.ks, 0.5);
  EXPECT_NEAR(m.shine, 34, 0.1);
  EXPECT_DOUBLE_EQ(m.transmittance, 0.5);
  ASSERT_EQ(lost.size(), 3u);
  EXPECT_NE(lost[0].find("highlight"), std::string::npos);
  EXPECT_NE(lost[1].find("ambient"), std::string::npos);
  EXPECT_NE(lost[2].find("channel"), std::string::npos);
  lost.clear();
  StraussShader({0.30, 0, 0, {1, 1, 1}, {1, 1, 1}}).approximate(&lost);
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_NE(lost[0].find("Strauss"), std::string::npos);
}

TEST(SippShaders, ApproximationIsAlwaysFinite) {
  for (const double v : {0.0, 1e-200, 1e-9, 0.5, 1.0, 2.0}) {
    BasicParameters b = basic();
    b.c3 = v;
    EXPECT_TRUE(std::isfinite(BasicShader(b).approximate().shine)) << v;
    const Material m = StraussShader({0.1, std::min(v, 1.0), 1, {1, 1, 1}, {1, 1, 1}}).approximate();
    EXPECT_TRUE(std::isfinite(m.shine) && m.ks >= 0 && m.kd >= 0) << v;
  }
}

TEST(SippShaders, DescriptionsTellShadersApart) {
  EXPECT_EQ(BasicShader(basic()).describe(), "basic 0.25 0.5 0.2 {0.8 0.4 0.2} {1 1 1}");
  EXPECT_EQ(PhongShader(phong()).describe(), "phong 0.25 0.5 0.75 8 {0.8 0.4 0.2} {1 1 1}");
  BasicParameters nearly = basic();
  nearly.c3 = std::nextafter(nearly.c3, 1);
  EXPECT_NE(BasicShader(basic()).describe(), BasicShader(nearly).describe());
  EXPECT_EQ(StraussShader({0.1, 0.5, 0.25, {1, 0, 0}, {1, 1, 0.5}}).describe(),
            "strauss 0.1 0.5 0.25 {1 0 0} {1 1 0.5}");
}

}  // namespace
}  // namespace farop
