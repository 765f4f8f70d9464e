// SPDX-License-Identifier: GPL-3.0-or-later
// balls: the sphereflake, spheres on spheres over a floor.
#include <array>
#include <cmath>
#include <numbers>

#include "spd/scenes.h"

namespace farop {
namespace {

/// Directions to the nine children of a sphere whose own direction is +z.
using ChildDirections = std::array<V3d, 9>;

ChildDirections child_directions() {
  const double d = 1 / std::sqrt(2.0);
  const M44d tilt = rotation({1, -1, 0}, std::asin(2 / std::sqrt(6.0)));
  const V3d trio[3] = {V3d(d, d, 0) * tilt, V3d(d, 0, -d) * tilt, V3d(0, d, -d) * tilt};
  ChildDirections directions;
  for (std::size_t third = 0; third < 3; ++third) {
    const M44d turn = rotation({0, 0, 1}, 2 * std::numbers::pi / 3 * static_cast<double>(third));
    for (std::size_t i = 0; i < 3; ++i) directions[3 * third + i] = trio[i] * turn;
  }
  return directions;
}

/// Turns +z to `direction`.
M44d turn_from_z(const V3d& direction) {
  if (direction.z >= 0.9999) return {};
  if (direction.z <= -0.9999) return rotation({0, 1, 0}, std::numbers::pi);
  return rotation(V3d(0, 0, 1).cross(direction), std::acos(direction.z));
}

void print_flake(NffPrinter& printer, const ChildDirections& directions, int depth, const Sphere& sphere,
                 const V3d& direction) {
  printer.sphere(sphere);
  if (depth == 0) return;
  const M44d turn = turn_from_z(direction);
  const double distance = sphere.radius * 4 / 3;
  for (const V3d& child_direction : directions) {
    const V3d child = sphere.center + (child_direction * turn) * distance;
    print_flake(printer, directions, depth - 1, {child, sphere.radius / 3},
                (child - sphere.center) / distance);
  }
}

}  // namespace

void print_balls(NffPrinter& printer, const SceneForm& form) {
  printer.background(k_sky);
  printer.view({.from = {2.1, 1.3, 1.7}, .at = V3d(0), .up = {0, 0, 1}, .angle = 45, .hither = 0.01});
  for (const V3d& light : {V3d(4, 3, 2), V3d(1, -4, 4), V3d(-3, 1, 5)}) printer.light(light);

  printer.fill(material({1, 0.75, 0.33}, 0.8, 0, 0, 0, 1));
  printer.polygon(std::array{V3d(12, 12, -0.5), V3d(-12, 12, -0.5), V3d(-12, -12, -0.5), V3d(12, -12, -0.5)});
  printer.fill(material({1, 0.9, 0.7}, 0.5, 0.5, 37, 0, 1));
  print_flake(printer, child_directions(), form.size, {V3d(0), 0.5}, {0, 0, 1});
}

}  // namespace farop
