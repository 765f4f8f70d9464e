// SPDX-License-Identifier: GPL-3.0-or-later
// gears: a cube of meshed gears over a ground polygon; concave faces of 144 corners.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "spd/scenes.h"

namespace farop {
namespace {

constexpr int k_teeth = 36;
constexpr int k_corners = 4 * k_teeth;

struct Gear {
  V3d center;  ///< of the top face
  double tip_radius, root_radius, thickness;
  double start_angle;  ///< of the first tooth, radians
};

/// Corner of the outline, `height` above 0; counter-clockwise from above, four corners a tooth.
V3d outline_corner(const Gear& gear, int corner, double height) {
  constexpr double k_share_of_tooth[4] = {-0.19, 0.19, 0.3, 0.7};
  const double tooth_angle = 2 * std::numbers::pi / k_teeth;
  const int tooth = corner / 4, part = corner % 4;
  const double angle = gear.start_angle + (tooth + k_share_of_tooth[part]) * tooth_angle;
  const double radius = part < 2 ? gear.tip_radius : gear.root_radius;
  return {gear.center.x + radius * std::cos(angle), gear.center.y + radius * std::sin(angle), height};
}

void print_gear(NffPrinter& printer, const Gear& gear) {
  std::vector<CornerLine> top, bottom;
  top.reserve(k_corners);
  bottom.reserve(k_corners);
  for (int i = 0; i < k_corners; ++i) {
    top.emplace_back(outline_corner(gear, i, gear.center.z));
    bottom.emplace_back(outline_corner(gear, i, gear.center.z - gear.thickness));
  }

  printer.begin_polygon(k_corners);
  for (const CornerLine& line : top) printer.corner(line);
  printer.end_polygon();

  for (std::size_t i = 0; i < k_corners; ++i) {
    const std::size_t j = (i + 1) % k_corners;
    printer.begin_polygon(4);
    printer.corner(top[i]);
    printer.corner(bottom[i]);
    printer.corner(bottom[j]);
    printer.corner(top[j]);
    printer.end_polygon();
  }

  // Clockwise from above, beginning like the top face with the first tooth: corners 1, 0, 143, 142, ..., 2.
  printer.begin_polygon(k_corners);
  for (std::size_t i = 0; i < k_corners; ++i) printer.corner(bottom[(k_corners + 1 - i) % k_corners]);
  printer.end_polygon();
}

/// Pseudo-random channel of a gear's colour: `k` sevenths, the fractional part.
double channel(int k) {
  const double sevenths = k / 7.0;
  return 0.01 + (sevenths - std::floor(sevenths));
}

Material gear_material(int ix, int iy, int iz) {
  const Rgb c{channel((3 * ix + 2 * iy + iz + 1) * 5), channel((3 * iy + 2 * iz + ix + 1) * 3),
              channel((3 * iz + 2 * ix + iy + 1) * 2)};
  const double largest = std::max({c.r, c.g, c.b});
  const Rgb color{c.r / largest, c.g / largest, c.b / largest};
  const bool glass = (4 * ix + 2 * iy + iz) % 5 == 0;
  return glass ? material(color, 0.2, 0, 0, 0.8, 1.1) : material(color, 1, 0, 0, 0, 0);
}

}  // namespace

void print_gears(NffPrinter& printer, const SceneForm& form) {
  printer.background(k_sky);
  printer.view({.from = {-1.1, -2.1, 2.6}, .at = V3d(0), .up = {0, 0, 1}, .angle = 45, .hither = 1});
  for (const V3d& light :
       {V3d(2, 4, 4), V3d(-2, 4, 3), V3d(2, -2.5, 2.5), V3d(-1, -4, 2), V3d(-1.111, -2.121, 2.626)})
    printer.light(light);

  printer.fill(material({1, 0.85, 0.7}, 0.3, 0.6, 37, 0, 0));
  printer.polygon(std::array{V3d(2, 2, 0), V3d(-2, 2, 0), V3d(-2, -2, 0), V3d(2, -2, 0)});

  const int size = form.size;
  const double overlap = 1 - 0.9;  // of meshing teeth, in gear radii
  const double radius = 1 / (size - (size - 1) * overlap / 2);
  const double step = radius * (2 - overlap);
  const double thickness = std::min(0.1, 1 / (2.0 * size));
  for (int iz = 0; iz < size; ++iz) {
    for (int iy = 0; iy < size; ++iy) {
      for (int ix = 0; ix < size; ++ix) {
        printer.fill(gear_material(ix, iy, iz));
        const V3d center(-1 + radius + ix * step, -1 + radius + iy * step,
                         1 - iz / static_cast<double>(size));
        // Neighbours are turned by half a tooth, so that they mesh.
        const double start_angle = (ix + iy + iz) % 2 == 1 ? std::numbers::pi / k_teeth : 0;
        print_gear(printer, {center, 0.995 * radius, (1 - overlap) * radius, thickness, start_angle});
      }
    }
  }
}

}  // namespace farop
