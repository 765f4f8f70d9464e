// SPDX-License-Identifier: GPL-3.0-or-later
#include "shadow/shadow_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "scene/surface_builder.h"
#include "shading/noise.h"
#include "shading/sipp_shaders.h"

namespace farop {
namespace {

/// Counts its calls: a shadow is none of its business.
class CountingShader : public PhongShader {
 public:
  CountingShader() : PhongShader({0.3, 1, 0, 1, {1, 1, 1}, {0.5, 0.5, 0.5}}) {}
  Shaded shade(const ShadingPoint& point, const ShadingFrame& frame) const override {
    ++calls;
    return PhongShader::shade(point, frame);
  }
  mutable int calls = 0;
};

std::shared_ptr<Surface> square(double half, double z, bool facing_up = true) {
  SurfaceBuilder builder;
  builder.begin_polygon(false);
  const double s = facing_up ? half : -half;
  builder.add_corner(V3d(-s, -half, z));
  builder.add_corner(V3d(s, -half, z));
  builder.add_corner(V3d(s, half, z));
  builder.add_corner(V3d(-s, half, z));
  builder.end_polygon();
  return std::make_shared<Surface>(builder.take());
}

/// A floor of 20 x 20 in z = 0 and a plate of 2 x 2 above it at z = 1, lit by a spot at z = 4: the plate's
/// shadow on the floor is 8/3 wide.
struct Bench {
  Bench() {
    auto object = std::make_shared<Object>();
    object->surfaces = {square(10, 0), square(1, 1, false)};
    object->surfaces[1]->shader = shader;
    object->surfaces[1]->material = shader->approximate();  // half transparent
    scene.root.children = {object};
    light.kind = LightKind::spot_sharp;
    light.position = V3d(0, 0, 4), light.target = V3d(0, 0, 0);
    light.opening_degrees = 90;
    light.casts_shadows = true;
  }
  ShadowMap map() const {
    return {scene, light,
            std::make_shared<const ShadowJitter>([r = Rand48()]() mutable { return r.next(); })};
  }
  std::shared_ptr<CountingShader> shader = std::make_shared<CountingShader>();
  Scene scene;
  Light light;
};

TEST(ShadowMap, HidesWhatLiesBehind) {
  const Bench bench;
  const ShadowMap map = bench.map();
  // A texel of the map is 8/255 wide on the floor, and a lookup reaches one further.
  const double edge = 4.0 / 3, margin = 3 * 8.0 / 255;
  for (const double along : {-1.0, 0.0, 0.6}) {
    EXPECT_EQ(map.unshadowed(V3d(edge - margin, along, 0)), 0);
    EXPECT_EQ(map.unshadowed(V3d(edge + margin, along, 0)), 1);
    EXPECT_EQ(map.unshadowed(V3d(along, -edge + margin, 0)), 0);
    EXPECT_EQ(map.unshadowed(V3d(along, -edge - margin, 0)), 1);
  }
  EXPECT_EQ(map.unshadowed(V3d(0, 0, 0.5)), 0) << "between plate and floor";
  EXPECT_EQ(map.unshadowed(V3d(0, 0, 1.5)), 1) << "above the plate";
  EXPECT_EQ(bench.shader->calls, 0);
}

TEST(ShadowMap, SurfacesDoNotShadowThemselves) {
  const Bench bench;
  const ShadowMap map = bench.map();
  for (double x = -3.9; x < 4; x += 0.0917) {
    for (double y = -3.9; y < 4; y += 0.0917) {
      if (std::max(std::abs(x), std::abs(y)) < 1.5) {
        const bool on_plate = std::max(std::abs(x), std::abs(y)) < 0.95;
        EXPECT_TRUE(!on_plate || map.unshadowed(V3d(x, y, 1)) == 1);
        continue;
      }
      EXPECT_EQ(map.unshadowed(V3d(x, y, 0)), 1) << x << ' ' << y;
    }
  }
}

TEST(ShadowMap, BiasIsAFractionOfTheDistanceToTheTarget) {
  Bench bench;
  bench.light.target = V3d(0, 0, -36);  // 40 away: bias 0.2
  const ShadowMap map = bench.map();
  EXPECT_EQ(map.unshadowed(V3d(0, 0, 1 - 0.15)), 1);
  EXPECT_EQ(map.unshadowed(V3d(0, 0, 1 - 0.25)), 0);
}

TEST(ShadowMap, OutsideTheMapAllIsLit) {
  const Bench bench;
  const ShadowMap map = bench.map();
  EXPECT_EQ(map.unshadowed(V3d(4.2, 0, -0.001)), 1) << "outside the cone's square";
  EXPECT_EQ(map.unshadowed(V3d(0, 0, 5)), 1) << "behind the light";
  EXPECT_EQ(map.unshadowed(V3d(0, 0, 4)), 1) << "the light's own place";
  EXPECT_EQ(map.unshadowed(V3d(std::nan(""), 0, 0)), 1);
}

TEST(ShadowMap, LargerMapsHaveSoftBorders) {
  Bench bench;
  bench.light.shadow_size = 1024;  // 4 x 4 samples in a box of 4 texels
  const ShadowMap map = bench.map();
  const double texel = 8.0 / 1023;
  double before = 0;
  int between = 0;
  for (double at = -6; at <= 6; at += 0.25) {
    // Jitter moves single points; the mean along the border rises.
    double mean = 0;
    for (int i = 0; i < 64; ++i) {
      const double fraction = map.unshadowed(V3d(4.0 / 3 + at * texel, -0.8 + 0.025 * i, 0));
      mean += fraction / 64;
      const double sixteenths = fraction * 16;
      EXPECT_EQ(sixteenths, std::floor(sixteenths));
    }
    EXPECT_GE(mean, before - 0.05) << at;
    before = std::max(before, mean);
    between += mean > 0.05 && mean < 0.95 ? 1 : 0;
    EXPECT_TRUE(at >= -3 || mean == 0) << at << ' ' << mean;
    EXPECT_TRUE(at <= 3 || mean == 1) << at << ' ' << mean;
  }
  EXPECT_GT(between, 8);
}

TEST(ShadowMap, TheSmallestMapsWork) {
  for (const int size : {-5, 0, 1, 2, 100}) {
    Bench bench;
    bench.light.shadow_size = size;
    const ShadowMap map = bench.map();
    const double fraction = map.unshadowed(V3d(0, 0, 0));
    EXPECT_TRUE(fraction == 0 || fraction == 1) << size;
  }
}

TEST(ShadowMap, WorksInEveryDirection) {
  for (const V3d& axis :
       {V3d(1, 0, 0), V3d(0, -1, 0), V3d(0, 0, 1), V3d(1, 1, 1), V3d(-2, -2, -2), V3d(3, -1, 2)}) {
    Bench bench;
    // Turn scene and light together so that the light shines along -axis.
    M44d turn;
    const V3d z = axis.normalized();
    const V3d x = (std::abs(z.x) < 0.9 ? V3d(1, 0, 0) : V3d(0, 1, 0)).cross(z).normalized();
    const V3d y = z.cross(x);
    for (int c = 0; c < 3; ++c) turn[0][c] = x[c], turn[1][c] = y[c], turn[2][c] = z[c], turn[3][c] = 7 * c;
    bench.scene.root.children[0]->to_parent = turn;
    bench.light.position = V3d(0, 0, 4) * turn, bench.light.target = V3d(0, 0, 0) * turn;
    const ShadowMap map = bench.map();
    EXPECT_EQ(map.unshadowed(V3d(0, 0, 0) * turn), 0);
    EXPECT_EQ(map.unshadowed(V3d(0.9, 0, 0) * turn), 0);
    EXPECT_EQ(map.unshadowed(V3d(2.1, 0.3, 0) * turn), 1);
    EXPECT_EQ(map.unshadowed(V3d(-0.5, 2.1, 0) * turn), 1);
    EXPECT_EQ(map.unshadowed(V3d(0, 0, 1) * turn), 1);
  }
}

TEST(ShadowMap, ALightAtItsOwnTargetHasNoMap) {
  Bench bench;
  bench.light.target = bench.light.position;
  EXPECT_EQ(bench.map().unshadowed(V3d(0, 0, 0)), 1);
}

TEST(ShadowMap, SurvivesAnyCone) {
  for (const double degrees : {-10.0, 0.0, 179.9, 360.0, 1e300, std::nan("")}) {
    Bench bench;
    bench.light.opening_degrees = degrees;
    const double fraction = bench.map().unshadowed(V3d(0, 0, 0));
    // At 179 degrees a texel is wider than the plate, and its middle misses it.
    EXPECT_EQ(fraction, degrees > 170 ? 1 : 0) << degrees;
  }
  Bench lost;
  lost.light.position = V3d(std::nan(""), 0, 0);
  EXPECT_EQ(lost.map().unshadowed(V3d(0, 0, 0)), 1);
}

TEST(ShadowMap, AnswersAlikeWhenAskedAgain) {
  Bench bench;
  bench.light.shadow_size = 512;
  const ShadowMap map = bench.map();
  for (double x = 1.25; x < 1.4; x += 0.001) {
    const double once = map.unshadowed(V3d(x, 0.123, 0));
    map.unshadowed(V3d(0.3, 0.1, 0));
    EXPECT_EQ(map.unshadowed(V3d(x, 0.123, 0)), once);
  }
}

TEST(CastShadows, GivesMapsToActiveSpotsThatWantThem) {
  Bench bench;
  Light off = bench.light, quiet = bench.light, point = bench.light, directional = bench.light,
        soft = bench.light;
  off.active = false;
  quiet.casts_shadows = false;
  point.kind = LightKind::point;
  directional.kind = LightKind::directional, directional.position = V3d(0, 0, 1);
  soft.kind = LightKind::spot_soft;
  bench.scene.lights = {off, quiet, point, bench.light, directional, soft};
  Camera camera;
  camera.from = V3d(5, -8, 6), camera.at = V3d(0, 0, 0);
  GeometrySetup setup = prepare_geometry(bench.scene, camera, Viewport{}, GeometryOptions{});
  int drawn = 0;
  const int maps = cast_shadows(bench.scene, setup, [&] { return ++drawn, 0.5; });
  EXPECT_EQ(maps, 2);
  EXPECT_EQ(drawn, 256);
  const auto& lights = setup.shading.lights;
  ASSERT_EQ(lights.size(), 5u);
  EXPECT_TRUE(lights[0].shadow == nullptr && lights[1].shadow == nullptr && lights[3].shadow == nullptr);
  ASSERT_TRUE(lights[2].shadow != nullptr && lights[4].shadow != nullptr);
  // Points in eye space, where the lights are.
  const M44d to_eye = world_to_eye(camera);
  EXPECT_EQ(illuminate(lights[2], V3d(0.5, 0.2, 0) * to_eye).fraction, 0);
  EXPECT_EQ(illuminate(lights[2], V3d(2, 0.2, 0) * to_eye).fraction, 1);
  EXPECT_EQ(illuminate(lights[4], V3d(0.5, 0.2, 0) * to_eye).fraction, 0);
  EXPECT_GT(illuminate(lights[4], V3d(2, 0.2, 0) * to_eye).fraction, 0);
}

TEST(CastShadows, RefusesMoreTexelsThanAFrameMayHave) {
  Bench bench;
  bench.light.shadow_size = 1 << 30;  // counts as the largest: 2^26 texels
  bench.scene.lights.assign(5, bench.light);
  GeometrySetup setup = prepare_geometry(bench.scene, Camera{}, Viewport{}, GeometryOptions{});
  int drawn = 0;
  try {
    cast_shadows(bench.scene, setup, [&] { return ++drawn, 0.5; });
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::input);
    EXPECT_STREQ(error.what(), "5 shadow maps have 335544320 texels in all, expected 268435456 at most");
  }
  EXPECT_EQ(drawn, 0);
}

TEST(CastShadows, WithoutSuchLightsDrawsNothing) {
  Bench bench;
  bench.light.casts_shadows = false;
  bench.scene.lights = {bench.light};
  GeometrySetup setup = prepare_geometry(bench.scene, Camera{}, Viewport{}, GeometryOptions{});
  int drawn = 0;
  EXPECT_EQ(cast_shadows(bench.scene, setup, [&] { return ++drawn, 0.5; }), 0);
  EXPECT_EQ(drawn, 0);
}

}  // namespace
}  // namespace farop
