// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "raster/reference.h"
#include "shading/material.h"
#include "shading/reflection.h"
#include "unit/raster/raster_test_support.h"

namespace farop::test {
namespace {

constexpr int k_size = 33;

Material shiny() {
  Material m;
  m.color = {0.8, 0.5, 0.2};
  m.kd = 0.6, m.ks = 0.4, m.shine = 30;
  return m;
}

/// The eye looks along +z at a square of the plane z = 4.
std::vector<V3f> square_positions() {
  return {V3f(-2, -2, 4), V3f(2, -2, 4), V3f(2, 2, 4), V3f(-2, 2, 4)};
}

InternalRasterizerOptions phong_with(std::vector<LightSource> lights) {
  InternalRasterizerOptions options;
  options.mode = DrawMode::phong;
  options.shading.lights = std::move(lights);
  return options;
}

Corners square(int z = 100) {
  return rectangle(0, 0, k_size - 1, k_size - 1, z, 0, 0, 0);
}

TEST(Phong, AsksForNormalsAndPositions) {
  EXPECT_TRUE(InternalRasterizer(phong_with({})).wants().normals);
  EXPECT_FALSE(InternalRasterizer({}).wants().normals);
}

TEST(Phong, EqualsFlatShadingOnAPlaneWithoutHighlightAndALightFarAway) {
  Material matt = shiny();
  matt.ks = 0;
  const std::vector<LightSource> lights = {{V3d(1e9, 2e9, -3e9), {1, 1, 1}}};
  const V3f normal(0, 0, -1);
  Drawing drawing;
  drawing.add(square(), &matt, std::vector<V3f>(4, normal), square_positions());
  const Framebuffer phong = draw(make_frame(k_size, k_size), drawing, phong_with(lights));

  const Rgb flat = reflect(matt, lights, V3d(0, 0, 4), V3d(normal), V3d(0, 0, 0));
  Drawing flat_drawing;
  flat_drawing.add(rectangle(0, 0, k_size - 1, k_size - 1, 100, int(round_half_up(255 * flat.r)),
                             int(round_half_up(255 * flat.g)), int(round_half_up(255 * flat.b))));
  const Framebuffer gouraud = draw(make_frame(k_size, k_size), flat_drawing);
  EXPECT_EQ(phong.rgb, gouraud.rgb);
  EXPECT_EQ(phong.depth, gouraud.depth);
  EXPECT_GT(red(gouraud, 5, 5), 100);
}

TEST(Phong, LightsEveryPixelWithItsOwnNormalAndPosition) {
  const Material material = shiny();
  const std::vector<LightSource> lights = {{V3d(0.5, 0.5, 0), {0.7, 0.7, 0.7}},
                                           {V3d(-3, 2, 1), {0.3, 0.2, 0.6}}};
  Random random(41);
  for (int i = 0; i < 60; ++i) {
    Corners corners = random_polygon(random, Shape::triangle, 0, k_size - 1, 0, k_size - 1);
    std::vector<V3f> normals, positions;
    const auto number = [&] { return static_cast<float>(random.integer(-100, 100)) / 100; };
    for (int k = 0; k < 3; ++k) {
      normals.push_back(V3f(number(), number(), -1).normalized());
      positions.push_back(V3f(2 * number(), 2 * number(), 5 + number()));
    }
    Drawing drawing;
    drawing.add(corners, &material, normals, positions);
    const Framebuffer picture = draw(make_frame(k_size, k_size), drawing, phong_with(lights));
    const auto weight = [&](std::size_t corner, int x, int y) {
      std::vector<std::int64_t> one(3, 0);
      one[corner] = 1;
      const auto f = reference::AffineFunction::through(corners, one);
      const reference::Rational w = f->at(0, x, y);
      return static_cast<double>(w.numerator) / static_cast<double>(w.denominator);
    };
    for (int y = 0; y < k_size; ++y) {
      for (int x = 0; x < k_size; ++x) {
        if (!reference::covers(corners, 0, x, y)) continue;
        V3d normal(0), position(0);
        for (std::size_t k = 0; k < 3; ++k) {
          normal += V3d(normals[k]) * weight(k, x, y), position += V3d(positions[k]) * weight(k, x, y);
        }
        const Rgb c = reflect(material, lights, position, normal.normalized(), V3d(0, 0, 0));
        const std::size_t pixel = 3 * picture.pixel(x, y);
        ASSERT_NEAR(picture.rgb[pixel], 255 * c.r, 0.501);
        ASSERT_NEAR(picture.rgb[pixel + 1], 255 * c.g, 0.501);
        ASSERT_NEAR(picture.rgb[pixel + 2], 255 * c.b, 0.501);
      }
    }
  }
}

TEST(Phong, ShowsAHighlightInTheMiddleOfAPolygon) {
  const Material material = shiny();
  Drawing drawing;
  drawing.add(square(), &material, std::vector<V3f>(4, V3f(0, 0, -1)), square_positions());
  const Framebuffer picture =
      draw(make_frame(k_size, k_size), drawing, phong_with({{V3d(0, 0, 0), {1, 1, 1}}}));
  EXPECT_GT(red(picture, k_size / 2, k_size / 2), red(picture, 1, 1) + 80);
}

TEST(Phong, LightsOpaqueSamplesOnceHoweverManyLayersThereAre) {
  const Material material = shiny();
  Drawing drawing;
  for (int z = 30; z > 0; --z) {  // back to front: every layer is visible when drawn
    drawing.add(square(z), &material, std::vector<V3f>(4, V3f(0, 0, -1)), square_positions());
  }
  InternalRasterizerOptions options = phong_with({{V3d(0, 0, 0), {1, 1, 1}}});
  options.tuning.path = RasterPath::plain;  // which counts
  InternalRasterizer rasterizer(options);
  rasterizer.begin_frame(make_frame(k_size, k_size));
  rasterizer.polygons(drawing.batch);
  rasterizer.end_frame();
  EXPECT_EQ(rasterizer.counts().visible_fragments, 30u * 32 * 32);
  EXPECT_EQ(rasterizer.counts().reflections, 32u * 32);
}

TEST(Phong, TakesInterpolatedColoursWithoutAMaterialAlsoOverALitSurface) {
  const Material material = shiny();
  Drawing drawing;
  drawing.add(square(50), &material, std::vector<V3f>(4, V3f(0, 0, -1)), square_positions());
  drawing.add(rectangle(0, 0, 16, 16, 20, 10, 20, 30), nullptr, std::vector<V3f>(4, V3f(0, 0, -1)),
              square_positions());
  const Framebuffer picture =
      draw(make_frame(k_size, k_size), drawing, phong_with({{V3d(0, 0, 0), {1, 1, 1}}}));
  EXPECT_EQ(red(picture, 8, 8), 10);
  EXPECT_GT(red(picture, 20, 20), 100);
}

TEST(Phong, CompositesLitTransparentFragments) {
  Material glass = shiny();
  glass.ks = 0, glass.transmittance = 0.75;
  const std::vector<LightSource> lights = {{V3d(0, 0, -1e9), {1, 1, 1}}};
  Drawing drawing;
  drawing.add(rectangle(0, 0, k_size - 1, k_size - 1, 50, 200, 100, 0), nullptr,
              std::vector<V3f>(4, V3f(0, 0, -1)), square_positions());
  drawing.add(square(20), &glass, std::vector<V3f>(4, V3f(0, 0, -1)), square_positions());
  const Framebuffer picture = draw(make_frame(k_size, k_size), drawing, phong_with(lights));
  // I = 0.8 (0.3 + 0.6) = 0.72
  EXPECT_EQ(red(picture, 10, 10), int(round_half_up(0.25 * 0.72 * 255 + 0.75 * 200)));
}

}  // namespace
}  // namespace farop::test
