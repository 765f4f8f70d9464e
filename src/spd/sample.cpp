// SPDX-License-Identifier: GPL-3.0-or-later
// sample: three tori, a cone and a disc.
#include <cmath>
#include <numbers>
#include <vector>

#include "spd/scenes.h"

namespace farop {
namespace {

constexpr int k_disc_resolution = 4;

/// Takes +z to the direction of `axis`.
M44d turn_to_axis(const V3d& axis) {
  const V3d n = axis.normalized();
  const V3d hinge = std::abs(n.z) == 1 ? V3d(1, 0, 0) : V3d(-n.y, n.x, 0);
  return rotation(hinge, std::acos(n.z));
}

struct Torus {
  V3d center, axis;
  double ring_radius, tube_radius;
};

/// 2 (4R)^2 triangles, also in the form that keeps spheres and cones: NFF has no torus.
void print_torus(NffPrinter& printer, const Torus& torus, int resolution) {
  const int steps = 4 * resolution;
  const M44d turn = turn_to_axis(torus.axis);
  const auto corner = [&](int tube_step, int ring_step) {
    const double theta = 2 * std::numbers::pi * tube_step / steps,
                 phi = 2 * std::numbers::pi * ring_step / steps;
    const double from_axis = torus.ring_radius + torus.tube_radius * std::sin(theta);
    const V3d position(from_axis * std::cos(phi), from_axis * std::sin(phi),
                       torus.tube_radius * std::cos(theta));
    const V3d normal(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    return TessellationCorner{position * turn + torus.center, normal * turn};
  };
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      printer.patch({corner(i + 1, j + 1), corner(i, j + 1), corner(i, j)});
      printer.patch({corner(i + 1, j), corner(i + 1, j + 1), corner(i, j)});
    }
  }
}

/// Sectors of a ring; with no hole in the middle the printer leaves triangles.
void print_disc(NffPrinter& printer, const V3d& center, const V3d& normal, double inner_radius,
                double outer_radius) {
  const int sectors = 4 * k_disc_resolution;
  const M44d placement = turn_to_axis(normal) * M44d().setTranslation(center);
  const auto corner = [&](double radius, int i) {
    const double angle = 2 * std::numbers::pi * i / sectors;
    return V3d(radius * std::cos(angle), radius * std::sin(angle), 0) * placement;
  };
  for (int i = 0; i < sectors; ++i)
    printer.polygon(std::vector{corner(outer_radius, i), corner(outer_radius, i + 1),
                                corner(inner_radius, i + 1), corner(inner_radius, i)});
}

}  // namespace

void print_sample(NffPrinter& printer, const SceneForm& form) {
  printer.background({0.8, 0.8, 0.8});
  printer.view({.from = {0, 5, -5}, .at = V3d(0), .up = {0, 1, 0}, .angle = 45, .hither = 0.001});
  printer.light({-10, 20, -20});

  const auto fill = [&printer](const Rgb& color) { printer.fill(material(color, 0.7, 0, 10, 0, 1)); };
  fill({0, 1, 1});
  print_torus(printer, {{-1, 0, 0}, {1, 1, -0.5}, 2, 0.5}, form.resolution);
  fill({1, 1, 0});
  print_torus(printer, {{0, 0, 0}, {0, 1, -0.5}, 2, 0.5}, form.resolution);
  fill({1, 0, 1});
  print_torus(printer, {{1, 0, 0}, {-1, 1, -0.5}, 2, 0.5}, form.resolution);
  fill({1, 0, 0});
  printer.cone({{0, -2, 0}, 2, {0, 2, 0}, 0.1});
  fill({1, 0, 0});
  print_disc(printer, {0, -2, 0}, {0, 1, 0}, 0, 4);
}

}  // namespace farop
