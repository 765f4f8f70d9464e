// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/viewport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace farop {
namespace {

Viewport viewport(int x, int y, PixelFit fit = PixelFit::centres, int bits = 0) {
  Viewport v;
  v.resolution = {x, y, 1024, 256};
  v.pixel_fit = fit;
  v.subpixel_bits = bits;
  return v;
}

Camera camera(double angle, Fit fit = Fit::vertical) {
  Camera c;
  c.angle_degrees = angle;
  c.fit = fit;
  return c;
}

ScreenVertex map(const Viewport& v, const V3d& p, const Camera& c = camera(90), double hither = 1,
                 double yon = 3) {
  return DeviceMapping(v, view_tangents(c, v), hither, yon).to_device(p, {0, 0, 0});
}

TEST(ViewTangents, SquarePixelsFollowTheFitAndThePixelCount) {
  const double t = std::tan(std::numbers::pi / 8);
  const auto expect = [&](Fit fit, PixelFit pixels, int w, int h, double x, double y) {
    const ViewTangents v = view_tangents(camera(45, fit), viewport(w, h, pixels));
    EXPECT_NEAR(v.x, x, 1e-12) << static_cast<int>(fit) << " " << w << "x" << h;
    EXPECT_NEAR(v.y, y, 1e-12) << static_cast<int>(fit) << " " << w << "x" << h;
  };
  expect(Fit::vertical, PixelFit::edges, 640, 480, t * 640 / 480, t);
  expect(Fit::vertical, PixelFit::centres, 641, 481, t * 640 / 480, t);
  expect(Fit::horizontal, PixelFit::edges, 640, 480, t, t * 480 / 640);
  expect(Fit::smaller, PixelFit::edges, 640, 480, t * 640 / 480, t);
  expect(Fit::smaller, PixelFit::edges, 480, 640, t, t * 640 / 480);
  expect(Fit::both, PixelFit::edges, 640, 480, t, t);
  expect(Fit::vertical, PixelFit::centres, 1, 480, t, t);  // one pixel has no extent between centres
  expect(Fit::vertical, PixelFit::centres, 640, 1, t, t);
}

TEST(DeviceMapping, CentresFitPutsTheFrustumOnTheOutermostPixelCentres) {
  const Viewport v = viewport(512, 512);
  EXPECT_EQ(map(v, {-2, -2, 2}).x, 0);
  EXPECT_EQ(map(v, {-2, -2, 2}).y, 0);
  EXPECT_EQ(map(v, {2, 2, 2}).x, 511);
  EXPECT_EQ(map(v, {2, 2, 2}).y, 511);
  EXPECT_EQ(map(v, {0, 0, 2}).x, 256);  // 255.5, halves upwards
}

TEST(DeviceMapping, EdgesFitReachesHalfAPixelFurther) {
  Viewport v = viewport(512, 512, PixelFit::edges, 8);
  EXPECT_EQ(map(v, {0, 0, 2}).x, 255 * 256 + 128);
  EXPECT_EQ(map(v, {2, 2, 2}).x, 511 * 256);  // clamped to the last centre
  v.half_pixel_border = true;
  EXPECT_EQ(map(v, {2, 2, 2}).x, 511 * 256 + 128);
  EXPECT_EQ(map(v, {-2, -2, 2}).y, -128);
}

TEST(DeviceMapping, SubpixelBitsMultiplyBeforeRounding) {
  for (int bits = 0; bits <= 8; ++bits) {
    const ScreenVertex v = map(viewport(101, 101, PixelFit::centres, bits), {0.123, 0, 1});
    EXPECT_EQ(v.x, static_cast<int>(std::floor(50 * 1.123 * (1 << bits) + 0.5))) << bits;
  }
}

TEST(DeviceMapping, DepthRunsFromHitherToYonLinearInOneOverZ) {
  const Viewport v = viewport(10, 10);
  EXPECT_EQ(map(v, {0, 0, 1}).z, 0);
  EXPECT_EQ(map(v, {0, 0, 3}).z, 1023);
  EXPECT_EQ(map(v, {0, 0, 1.5}).z, 512);  // f (1 - d/z) / (f - d) = 3 (1/3) / 2 = 0.5, of 1023, rounded up
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(map(v, {0, 0, 2}, camera(90), 1, inf).z, 512);
  EXPECT_EQ(map(v, {0, 0, 1e300}, camera(90), 1, inf).z, 1023);
}

TEST(DeviceMapping, YDownCountsRowsFromTheTop) {
  Viewport v = viewport(100, 50);
  v.y_down = true;
  EXPECT_EQ(map(v, {0, 1, 1}).y, 0);
  EXPECT_EQ(map(v, {0, -1, 1}).y, 49);
  for (double y = -1; y <= 1; y += 0.01) {
    Viewport up = v;
    up.y_down = false;
    EXPECT_EQ(map(v, {0, y, 1}).y, 49 - map(up, {0, y, 1}).y);
  }
}

TEST(DeviceMapping, ColoursFillTheRange) {
  Viewport v = viewport(10, 10);
  v.resolution.color = 128;
  const ScreenVertex s =
      DeviceMapping(v, view_tangents(camera(90), v), 1, 3).to_device({0, 0, 2}, {0, 0.5, 1});
  EXPECT_EQ(s.r, 0);
  EXPECT_EQ(s.g, 64);  // 63.5, halves upwards
  EXPECT_EQ(s.b, 127);
}

TEST(DeviceMapping, OnePixelPicturesMapEverythingToIt) {
  EXPECT_EQ(map(viewport(1, 1), {0.7, -0.4, 1}).x, 0);
  EXPECT_EQ(map(viewport(1, 1), {0.7, -0.4, 1}).y, 0);
}

}  // namespace
}  // namespace farop
