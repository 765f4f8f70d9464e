// SPDX-License-Identifier: GPL-3.0-or-later
// jacks: six spheres on three cylinders, eight half as large ones in each, and so on.
#include "spd/scenes.h"

namespace farop {
namespace {

class JackPrinter {
 public:
  JackPrinter(NffPrinter& printer, const SceneForm& form) : printer_(printer), form_(form) {}

  /// A jack and what it holds; `scale` is that of `local_to_world`.
  void print(const M44d& local_to_world, double scale, int depth) {
    print_one(M44d().setScale(k_jack_scale) * local_to_world, k_jack_scale * scale);
    if (depth == form_.size) return;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        for (const double z : {-0.5, 0.5})
          print(M44d().setScale(0.5) * M44d().setTranslation(V3d(x, y, z)) * local_to_world, 0.5 * scale,
                depth + 1);
  }

 private:
  static constexpr double k_jack_scale = 0.75;

  void print_one(const M44d& to_world, double scale) {
    const V3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const V3d& axis : axes) {
      const Cone cone{-axis, 0.1, axis, 0.1};
      if (form_.tessellate)
        print_triangles(cone, to_world);
      else
        printer_.cone(
            {cone.base * to_world, cone.base_radius * scale, cone.apex * to_world, cone.apex_radius * scale});
    }
    for (const double sign : {1.0, -1.0}) {
      for (const V3d& axis : axes) {
        const Sphere sphere{axis * sign, 0.2};
        if (form_.tessellate)
          print_triangles(sphere, to_world);
        else
          printer_.sphere({sphere.center * to_world, sphere.radius * scale});
      }
    }
  }

  /// Triangles are made before the transformation and keep the normals' length after it, 1 / scale: readers
  /// get normals that are not unit.
  template <class Primitive>
  void print_triangles(const Primitive& local, const M44d& to_world) {
    const M44d normals_to_world = to_world.inverse().transposed();
    tessellate(local, form_.resolution, [&](const TessellationCorner(&triangle)[3]) {
      TessellationCorner moved[3];
      for (int i = 0; i < 3; ++i) {
        moved[i].position = triangle[i].position * to_world;
        normals_to_world.multDirMatrix(triangle[i].normal, moved[i].normal);
      }
      printer_.patch(moved);
    });
  }

  NffPrinter& printer_;
  const SceneForm& form_;
};

}  // namespace

void print_jacks(NffPrinter& printer, const SceneForm& form) {
  printer.background({0.2, 0.05, 0.2});
  printer.view({.from = {0, 0, -8},
                .at = V3d(0),
                .up = {0, 1, 0},
                .angle = 25,
                .hither = 0.001,
                .columns = 256,
                .rows = 256});
  printer.light({-10, 3, -20});
  printer.fill(material({0.737, 0.561, 0.561}, 0.7, 0.7, 20, 0, 1));
  const M44d turned = rotation({0, 1, 0}, radians(-20)) * rotation({1, 0, 0}, radians(-30));
  JackPrinter(printer, form).print(turned, 1, 1);
}

}  // namespace farop
