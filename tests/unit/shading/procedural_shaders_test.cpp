// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading/procedural_shaders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace farop {
namespace {

constexpr Rgb k_red{1, 0, 0}, k_green{0, 1, 0};

/// Noise 0 everywhere, so that patterns without turbulence are left.
std::shared_ptr<const NoiseTable> flat_noise(double value = 0) {
  return std::make_shared<const NoiseTable>([value] { return (value + 1) / 2; });
}

ShadingFrame lit_frame() {
  return {{{V3d(0, 0, 1), {0.5, 0.5, 0.5}, LightKind::directional}}, M44d()};
}

ShadingPoint textured(const V3d& texture) {
  return {V3d(0, 0, 0), V3d(0, 0, 1), texture, V3d(0, 0, 1)};
}

/// Mean over a part of the pattern that is large against its grain.
template <class Pattern>
Rgb sampled_mean(const Pattern& pattern) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-40, 40);
  Rgb sum;
  constexpr int count = 40000;
  for (int i = 0; i < count; ++i) {
    sum += pattern.color(V3d(coordinate(random), coordinate(random), coordinate(random)), *standard_noise());
  }
  return sum * (1.0 / count);
}

template <class Pattern>
void expect_mean(const Pattern& pattern) {
  const Rgb a = pattern.mean(), b = sampled_mean(pattern);
  EXPECT_NEAR(a.r, b.r, 0.04);
  EXPECT_NEAR(a.g, b.g, 0.04);
  EXPECT_NEAR(a.b, b.b, 0.04);
}

TEST(Marble, WithoutTurbulenceIsAStripeAlongX) {
  const MarblePattern marble{2, k_red, k_green};
  const auto red_at = [&](double sine) {
    return marble.color(V3d(std::asin(sine) / 2, 3, 4), *flat_noise()).r;
  };
  EXPECT_EQ(red_at(0.05), 0);
  EXPECT_EQ(red_at(-0.05), 0);
  EXPECT_NEAR(red_at(0.5), 7.0 / 6 - 1 / 3.5, 1e-12);
  EXPECT_NEAR(red_at(-0.5), 7.0 / 6 - 1 / 3.5, 1e-12);
  EXPECT_NEAR(red_at(0.1 + 1e-9), 1.0 / 6, 1e-6);
  EXPECT_NEAR(red_at(0.9 - 1e-9), 1, 1e-6);
  EXPECT_EQ(red_at(0.95), 1);
}

TEST(Marble, TurbulenceBendsTheStripes) {
  const MarblePattern marble{3, k_red, k_green};
  const V3d t(0.4, -0.2, 0.9);
  const double x =
      std::abs(std::sin(3 * 0.4 + 5 * standard_noise()->turbulence(V3d(3 * 0.4, 3 * -0.2, 3 * 0.9), 7)));
  const double share = x < 0.1 ? 0 : x < 0.9 ? 7.0 / 6 - 1 / (6.25 * x + 0.375) : 1;
  EXPECT_NEAR(marble.color(t, *standard_noise()).r, share, 1e-9);
}

TEST(Granite, AddsSixOctavesEachFinerThanTheLast) {
  const GranitePattern granite{2, k_red, k_green};
  const V3d t(0.13, 0.27, -0.41);
  // The factors are 4, 8, 16 ... and multiply up.
  double n = 0.5;
  double factor = 1;
  for (int i = 0; i < 6; ++i) {
    factor *= 4 * std::pow(2, i);
    n += 0.5 * standard_noise()->noise(t * (2 * factor)) / std::pow(2, i);
  }
  const Rgb c = granite.color(t, *standard_noise());
  EXPECT_NEAR(c.r, n, 1e-12);
  EXPECT_NEAR(c.g, 1 - n, 1e-12);
}

TEST(Bozo, PicksAColourByTheNoise) {
  const BozoPattern bozo{1, {{0, 0, 0}, {0.25, 0, 0}, {0.5, 0, 0}, {0.75, 0, 0}}};
  const V3d t(1, 2, 3);
  EXPECT_EQ(bozo.color(t, *flat_noise(-0.99)).r, 0);
  EXPECT_EQ(bozo.color(t, *flat_noise(-0.4)).r, 0.25);
  EXPECT_EQ(bozo.color(t, *flat_noise(0.1)).r, 0.5);
  EXPECT_EQ(bozo.color(t, *flat_noise(0.99)).r, 0.75);
  EXPECT_EQ(BozoPattern{}.color(t, *flat_noise()), (Rgb{1, 1, 1}));
}

TEST(Wood, WithoutTurbulenceHasRingsAroundX) {
  const WoodPattern wood{1, k_red, k_green};
  // At x = 2 the boards are not skewed; noise a little below 0 leaves out the streaks.
  const auto red_at = [&](double y, double z) { return wood.color(V3d(2, y, z), *flat_noise(-1e-9)).r; };
  EXPECT_EQ(red_at(3.05, 0), 1);
  EXPECT_EQ(red_at(0, 3.95), 0);
  EXPECT_NEAR(red_at(3.5, 0), 1 - std::pow(0.5 / 0.8 - 0.1, 6), 1e-6);
  EXPECT_NEAR(red_at(3, 4 * 1.1), red_at(std::hypot(3, 4.4), 0), 1e-9);
  // The next board begins anew, on both sides.
  for (const double board : {1.0, 2.0, -1.0, -3.0}) {
    EXPECT_NEAR(red_at(45 * board + 3.5, 0), red_at(3.5, 0), 1e-6);
    EXPECT_NEAR(red_at(0, 45 * board - 3.5), red_at(3.5, 0), 1e-6);
  }
  EXPECT_NEAR(red_at(22.4, 0), red_at(-22.4, 0), 1e-9);
  // The rings lean with x: by 0.05 a unit in y and z.
  EXPECT_NEAR(wood.color(V3d(12, 3.5 + 0.5, 0.5), *flat_noise(-1e-9)).r, red_at(3.5, 0), 1e-6);
  EXPECT_EQ(wood.color(V3d(2, 3.05, 0), *flat_noise(0.005)), k_green) << "a streak";
  // Noise -0.4 everywhere: rings shrink by 0.5 * 0.4 * 1.9375, the lean is 0.05 - 0.03 * 0.4.
  EXPECT_NEAR(wood.color(V3d(12, 3.8875 + 0.38, 0.38), *flat_noise(-0.4)).r, red_at(3.5, 0), 1e-6);
}

TEST(Planet, HasLandSeaAndClouds) {
  const PlanetPattern planet;
  // Noise n everywhere: ground from n (1 + 0.7 + ... + 0.7^9), clouds from n (1 + 0.6 + ... + 0.6^5).
  const double ground = (1 - std::pow(0.7, 10)) / 0.3, cloud = (1 - std::pow(0.6, 6)) / 0.4;
  const V3d t(0.1, 0.2, 0.3);
  const Rgb sea = planet.color(t, *flat_noise(-0.2));
  EXPECT_EQ(sea, (Rgb{0, 0, 1}));
  const double n = 0.2 / ground;
  const double share = n * cloud + 0.25;
  const Rgb land = planet.color(t, *flat_noise(n));
  EXPECT_NEAR(land.r, 0.28125 + share * (1 - 0.28125), 1e-12);
  EXPECT_NEAR(land.b, 0.09375 + share * (1 - 0.09375), 1e-12);
  EXPECT_NEAR(planet.color(t, *flat_noise(0.1 / ground)).r, 0.1 / ground * cloud + 0.25, 1e-12);
}

TEST(Patterns, AreFinishedByTheBasicShader) {
  const PatternFinish finish{0.25, 0.5, 0.2, {1, 0.5, 1}};
  const MarblePattern marble{3, {0.8, 0.4, 0.2}, {0.1, 0.2, 0.3}};
  const MarbleShader shader(finish, marble);
  const V3d t(0.4, -0.2, 0.9);
  const Shaded shaded = shader.shade(textured(t), lit_frame());
  const ShadingFrame frame = lit_frame();
  const Rgb expected =
      basic_color(finish.with(marble.color(t, *standard_noise())), textured(t), frame.lights);
  EXPECT_EQ(shaded.color, expected);
  EXPECT_EQ(shaded.opacity, finish.opacity);
  EXPECT_FALSE(shader.opaque());
  EXPECT_TRUE(shader.is_procedural());
  EXPECT_TRUE(shader.wants_texture());
}

TEST(Patterns, TakeTheNoiseOfTheFrame) {
  const BozoShader shader({1, 0, 1, {1, 1, 1}}, {1, {k_red, k_green}});
  ShadingFrame frame;
  frame.noise = flat_noise(-0.5);
  EXPECT_EQ(shader.shade(textured(V3d(1, 2, 3)), frame).color, k_red);
  frame.noise = flat_noise(0.5);
  EXPECT_EQ(shader.shade(textured(V3d(1, 2, 3)), frame).color, k_green);
}

TEST(Patterns, MeanIsThatOfManyPlaces) {
  expect_mean(MarblePattern{1, {0.9, 0.5, 0.1}, {0.2, 0.7, 0.4}});
  expect_mean(GranitePattern{1, {0.9, 0.5, 0.1}, {0.2, 0.7, 0.4}});
  expect_mean(BozoPattern{1, {{0.9, 0.5, 0.1}, {0.2, 0.7, 0.4}, {1, 1, 1}, {0, 0.3, 0}}});
  expect_mean(WoodPattern{1, {0.9, 0.5, 0.1}, {0.2, 0.7, 0.4}});
  expect_mean(PlanetPattern{});
}

TEST(Patterns, SurviveAnyTextureCoordinates) {
  const ShadingFrame frame = lit_frame();
  const PatternFinish finish{0.25, 0.5, 0.2, {1, 1, 1}};
  std::vector<std::unique_ptr<Shader>> shaders;
  shaders.push_back(std::make_unique<MarbleShader>(finish, MarblePattern{1e200, k_red, k_green}));
  shaders.push_back(std::make_unique<GraniteShader>(finish, GranitePattern{1e200, k_red, k_green}));
  shaders.push_back(std::make_unique<BozoShader>(finish, BozoPattern{1e200, {k_red, k_green}}));
  shaders.push_back(std::make_unique<WoodShader>(finish, WoodPattern{1e200, k_red, k_green}));
  shaders.push_back(std::make_unique<PlanetShader>(finish, PlanetPattern{}));
  for (const auto& shader : shaders) {
    for (const double v : {0.0, -1e9, 1e120, std::nan("")}) {
      const Rgb c = shader->shade(textured(V3d(v, -v, v)), frame).color;
      EXPECT_TRUE(c.r >= 0 && c.r <= 1 && c.g >= 0 && c.g <= 1 && c.b >= 0 && c.b <= 1)
          << shader->describe() << ' ' << v;
    }
  }
}

TEST(Bumpy, BendsTheNormalWhereTheNoiseSaysSo) {
  const V3d normal(0, 0, 3);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-9, 9);
  int bumps = 0, holes = 0;
  for (int i = 0; i < 200; ++i) {
    const V3d t(coordinate(random), coordinate(random), coordinate(random));
    const double n = standard_noise()->noise(t * 4.0);
    const V3d bent = V3d(0, 0, 1) + standard_noise()->gradient(t * 4.0);
    const auto with = [&](bool b, bool h) { return bumpy_normal({4, b, h}, normal, t, *standard_noise()); };
    EXPECT_EQ(with(true, true), bent);
    EXPECT_EQ(with(true, false), n < 0 ? bent : normal);
    EXPECT_EQ(with(false, true), n > 0 ? bent : normal);
    EXPECT_EQ(with(false, false), normal);
    ++(n < 0 ? bumps : holes);
  }
  EXPECT_GT(bumps, 20);
  EXPECT_GT(holes, 20);
}

TEST(Bumpy, BendsInWorldSpaceWhereverTheEyeIs) {
  const auto inner =
      std::make_shared<const BasicShader>(BasicParameters{0.1, 0.5, 0.3, {1, 1, 1}, {1, 1, 1}});
  const BumpyShader shader(inner, {3, true, true});
  ShadingFrame here = lit_frame();
  here.lights[0].position = V3d(1, 2, 2).normalized();
  const Rgb straight = shader.shade(textured(V3d(0.3, 0.1, 0.7)), here).color;
  M44d turn, mirror;
  turn.rotate(V3d(0.7, -0.3, 1.9));
  mirror.scale(V3d(1, 1, -1));
  const M44d world_to_eye = turn * mirror;
  const auto seen = [&](const V3d& v) {
    V3d out;
    world_to_eye.multDirMatrix(v, out);
    return out;
  };
  ShadingFrame turned = here;
  turned.eye_to_world = world_to_eye.inverse();
  turned.lights[0].position = seen(here.lights[0].position);
  ShadingPoint point = textured(V3d(0.3, 0.1, 0.7));
  point.normal = seen(point.normal), point.to_eye = seen(point.to_eye);
  const Rgb from_elsewhere = shader.shade(point, turned).color;
  EXPECT_NEAR(straight.r, from_elsewhere.r, 1e-12);
  EXPECT_NE(straight.r, inner->shade(textured(V3d(0.3, 0.1, 0.7)), here).color.r);
}

TEST(Mask, AsksItsTestForTheShader) {
  const auto ambient = [](const Rgb& color, double opacity) {
    return std::make_shared<const BasicShader>(BasicParameters{1, 0, 1, color, {opacity, opacity, opacity}});
  };
  const MaskShader mask(
      ambient(k_red, 1), ambient(k_green, 0.5), [](const V3d& t) { return t.x > 0; }, "right");
  EXPECT_EQ(mask.shade(textured(V3d(1, 0, 0)), {}).color, k_red);
  EXPECT_EQ(mask.shade(textured(V3d(-1, 0, 0)), {}).color, k_green);
  EXPECT_EQ(mask.shade(textured(V3d(-1, 0, 0)), {}).opacity, (Rgb{0.5, 0.5, 0.5}));
  EXPECT_FALSE(mask.opaque());
  EXPECT_FALSE(mask.invisible());
  EXPECT_EQ(mask.describe(), "mask right {basic 1 0 1 {1 0 0} {1 1 1}} {basic 1 0 1 {0 1 0} {0.5 0.5 0.5}}");
}

TEST(Procedural, DescriptionsHaveEveryParameter) {
  const PatternFinish finish{0.25, 0.5, 0.2, {1, 1, 0.5}};
  EXPECT_EQ(MarbleShader(finish, {3, k_red, k_green}).describe(),
            "marble 0.25 0.5 0.2 3 {1 0 0} {0 1 0} {1 1 0.5}");
  EXPECT_EQ(BozoShader(finish, {3, {k_red, k_green}}).describe(),
            "bozo 0.25 0.5 0.2 3 {{1 0 0} {0 1 0}} {1 1 0.5}");
  EXPECT_EQ(PlanetShader(finish, {}).describe(), "planet 0.25 0.5 0.2 {1 1 0.5}");
  const auto inner = std::make_shared<const PlanetShader>(finish, PlanetPattern{});
  EXPECT_EQ(BumpyShader(inner, {2, true, false}).describe(), "bumpy {planet 0.25 0.5 0.2 {1 1 0.5}} 2 BUMPS");
}

TEST(Procedural, ApproximationsNameThePattern) {
  std::vector<std::string> lost;
  const auto wood =
      std::make_shared<const WoodShader>(PatternFinish{0.3, 0, 1, {1, 1, 1}}, WoodPattern{1, k_red, k_green});
  const Material m = BumpyShader(wood, {}).approximate(&lost);
  EXPECT_EQ(m.color, wood->pattern().mean());
  ASSERT_EQ(lost.size(), 2u);
  EXPECT_EQ(lost[0], "bumps of bumpy shaders");
  EXPECT_EQ(lost[1], "patterns of wood shaders");
}

}  // namespace
}  // namespace farop
