// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces with shaders from the scene to the picture: what each pixel's shader call is told.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "shading/procedural_shaders.h"
#include "support/sipp_scene.h"

namespace farop {
namespace {

/// Shows a point as a colour: waves along x and y of the texture coordinates or of the place in the world.
class Waves : public Shader {
 public:
  Waves(bool of_texture, double opacity = 1) : of_texture_(of_texture), opacity_(opacity) {}

  static Rgb color_at(double x, double y) {
    return {0.5 + 0.5 * std::sin(x), 0.5 + 0.5 * std::sin(2 * y), 0.5};
  }
  Shaded shade(const ShadingPoint& point, const ShadingFrame& frame) const override {
    const V3d p = of_texture_ ? point.texture : point.position * frame.eye_to_world;
    return {color_at(p.x, p.y), {opacity_, opacity_, opacity_}};
  }
  bool opaque() const override { return opacity_ >= 1; }
  bool wants_texture() const override { return of_texture_; }
  Material approximate(std::vector<std::string>*) const override { return {}; }
  std::string describe() const override { return "waves"; }

 private:
  bool of_texture_;
  double opacity_;
};

/// A floor of one quad, seen at a low angle: its far edge is 12 times as far away as the near one.
Scene floor_scene(const std::shared_ptr<const Shader>& shader) {
  Scene scene = test::sipp_scene(V3d(0.5, -11, 2), V3d(0, 0, 0), 0.5, 240, 180);
  scene.view.background = Rgb{0, 0, 1};
  scene.root.children.front()->surfaces = {test::floor(10, 0, 1, shader)};
  return scene;
}

/// Where the ray through a pixel meets z = 0, by the window rule of PixelFit::edges.
std::optional<V3d> floor_point(const Scene& scene, int x, int y, int width, int height) {
  DiagnosticList list;
  const Camera camera = complete_camera(scene.view, list);
  const EyeAxes axes = eye_axes(camera);
  const double t = std::tan(camera.angle_degrees * std::numbers::pi / 360);
  const double sx = (2 * (x + 0.5) / width - 1) * t * width / height, sy = (2 * (y + 0.5) / height - 1) * t;
  const V3d ray = axes.depth + axes.right * sx + axes.up * sy;
  if (ray.z >= 0) return std::nullopt;
  const V3d p = camera.from - ray * (camera.from.z / ray.z);
  if (std::abs(p.x) > 9.9 || std::abs(p.y) > 9.5) return std::nullopt;
  return p;
}

/// Largest distance of a pixel from what the shader gives at the exact place, 0..255.
int largest_error(const Framebuffer& picture, const Scene& scene, double opacity = 1) {
  int largest = 0;
  int seen = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::optional<V3d> p = floor_point(scene, x, y, picture.width, picture.height);
      if (!p) continue;
      ++seen;
      const Rgb c = Waves::color_at(p->x, p->y) * opacity + Rgb{0, 0, 1} * (1 - opacity);
      const std::size_t at = 3 * picture.pixel(x, y);
      largest = std::max(largest, std::abs(picture.rgb[at] - static_cast<int>(255 * c.r + 0.5)));
      largest = std::max(largest, std::abs(picture.rgb[at + 1] - static_cast<int>(255 * c.g + 0.5)));
    }
  }
  EXPECT_GT(seen, 10000);
  return largest;
}

TEST(ShaderPictures, TextureCoordinatesFollowThePerspective) {
  const Scene scene = floor_scene(std::make_shared<const Waves>(true));
  EXPECT_LE(largest_error(test::draw(scene, DrawMode::phong), scene), 2);
}

TEST(ShaderPictures, PositionsFollowThePerspective) {
  const Scene scene = floor_scene(std::make_shared<const Waves>(false));
  EXPECT_LE(largest_error(test::draw(scene, DrawMode::phong), scene), 2);
}

TEST(ShaderPictures, SoDoThoseOfTransparentSurfaces) {
  for (const bool of_texture : {true, false}) {
    const Scene scene = floor_scene(std::make_shared<const Waves>(of_texture, 0.5));
    EXPECT_LE(largest_error(test::draw(scene, DrawMode::phong), scene, 0.5), 2);
  }
}

TEST(ShaderPictures, TheyStayRightWhereThePolygonIsClipped) {
  Scene scene = floor_scene(std::make_shared<const Waves>(true));
  scene.view.from = V3d(0.3, -4, 1), scene.view.at = V3d(0, 0, 0);  // over the floor: three sides cut it
  EXPECT_LE(largest_error(test::draw(scene, DrawMode::phong), scene), 2);
}

}  // namespace
}  // namespace farop
