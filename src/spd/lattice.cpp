// SPDX-License-Identifier: GPL-3.0-or-later
// lattice: spheres on the points of a cubic lattice, cylinders between neighbours, seen from inside.
#include <cmath>

#include "spd/scenes.h"

namespace farop {

void print_lattice(NffPrinter& printer, const SceneForm& form) {
  const int size = form.size;
  const double spacing = 1.0 / size;
  const double sphere_radius = 0.25 / size, rod_radius = 0.0625 / size;
  // Rods begin just inside the spheres.
  const double rod_start = 0.99 * sphere_radius * (1 - std::sqrt(rod_radius / sphere_radius));

  printer.background(k_sky);
  const int layer = size / 2;
  const double eye_x = (layer + 0.5) * spacing;
  const double half_step = 1 / (2.0 * size);
  printer.view({.from = {eye_x, 1, 1 - half_step},
                .at = {eye_x, -1, -1 - half_step},
                .up = {0.2, 1, 0},
                .angle = 60,
                .hither = 0});
  for (const V3d& light : {V3d(2, 0.5, 0.5), V3d(-1, 0.5, 0.5), V3d(0.5, 2, 0.5), V3d(0.5, -1, 0.5),
                           V3d(0.5, 0.5, 2), V3d(0.5, 0.5, -1)})
    printer.light(light);

  const Rgb rod_colors[3] = {{0.9, 0.1, 0.1}, {0.1, 0.9, 0.1}, {0.1, 0.1, 0.9}};
  const Material sphere_material = material({0.9, 0.9, 0.9}, 0.5, 0.5, 37, 0, 0);
  for (int x = 0; x <= size; ++x) {
    for (int y = 0; y <= size; ++y) {
      for (int z = 0; z <= size; ++z) {
        const double s = size;
        const V3d point(x / s, y / s, z / s);
        printer.fill(sphere_material);
        printer.sphere({point, sphere_radius});
        const int index[3] = {x, y, z};
        for (int axis = 0; axis < 3; ++axis) {
          if (index[axis] == size) continue;
          V3d along(0);
          along[axis] = 1;
          printer.fill(material(rod_colors[axis], 0.99, 0, 0, 0, 0));
          printer.cone(
              {point + along * rod_start, rod_radius, point + along * (spacing - rod_start), rod_radius});
        }
      }
    }
  }
}

}  // namespace farop
