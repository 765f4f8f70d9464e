// SPDX-License-Identifier: GPL-3.0-or-later
// rings: a pyramid of dodecahedral clusters of rings, in front of a wall.
#include <array>
#include <cmath>
#include <numbers>

#include "spd/scenes.h"

namespace farop {
namespace {

constexpr double k_pi = std::numbers::pi;
constexpr double k_tube_radius = 0.07412;
constexpr Rgb k_ring_colors[6] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}};

/// Corners of six pentagons that make one cluster: corner k of pentagon i at 5 i + k.
std::array<V3d, 30> cluster_corners() {
  std::array<V3d, 30> corners;
  for (std::size_t k = 0; k < 5; ++k) {
    const double angle = 2 * k_pi * static_cast<double>(k) / 5;
    corners[k] = V3d(std::cos(angle), std::sin(angle), 0) / (1 + k_tube_radius);
  }
  const M44d tilt = rotation({1, 0, 0}, 2 * std::acos(std::cos(k_pi / 3) / std::sin(k_pi / 5)));
  for (std::size_t i = 1; i <= 5; ++i) {
    const M44d turn = tilt * rotation({0, 0, 1}, k_pi * static_cast<double>(2 * i - 1) / 5);
    for (std::size_t k = 0; k < 5; ++k) corners[5 * i + k] = corners[k] * turn;
  }
  return corners;
}

void print_cluster(NffPrinter& printer, const std::array<V3d, 30>& corners, const V3d& offset) {
  for (std::size_t i = 0; i < 6; ++i) {
    printer.fill(material(k_ring_colors[i], 0.5, 0.2, 37, 0, 0));
    for (std::size_t k = 0; k < 5; ++k) {
      const V3d here = offset + corners[5 * i + k];
      const V3d previous = offset + corners[5 * i + (k + 4) % 5];
      printer.cone({here, k_tube_radius, previous, k_tube_radius});
      printer.sphere({here, k_tube_radius});
    }
  }
}

}  // namespace

void print_rings(NffPrinter& printer, const SceneForm& form) {
  const double spacing = 1 / std::sin(k_pi / 8);
  printer.background(k_sky);
  printer.view({.from = {-1, -spacing, 0.5},
                .at = {-1, -spacing + 1, 0.5},
                .up = {0, 0, 1},
                .angle = 45,
                .hither = 1});
  for (const V3d& light : {V3d(3, -spacing, 3), V3d(-4, -spacing, 1), V3d(2, -spacing, -4)})
    printer.light(light);

  printer.fill(material({1, 1, 1}, 1, 0, 0, 0, 0));
  const double y = spacing * (form.size + 1);
  const double x = 1.01 * (y + spacing) * std::tan(k_pi / 8);
  printer.polygon(std::array{V3d(x - 1, y, x + 0.5), V3d(-x - 1, y, x + 0.5), V3d(-x - 1, y, -x + 0.5),
                             V3d(x - 1, y, -x + 0.5)});

  const std::array<V3d, 30> corners = cluster_corners();
  for (int depth = 0; depth < form.size; ++depth)
    for (int iz = 0; iz <= depth; ++iz)
      for (int ix = 0; ix <= depth; ++ix)
        print_cluster(printer, corners, V3d(2 * ix - depth, spacing * (depth + 1), 2 * iz - depth));
}

}  // namespace farop
