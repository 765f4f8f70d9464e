// SPDX-License-Identifier: GPL-3.0-or-later
// tree: cones and spheres that branch in two.
#include <array>

#include "spd/scenes.h"

namespace farop {
namespace {

/// Radii shrink from branch to branch by this, whatever the lengths do.
constexpr double k_thinning = 0.67;

/// From a branch's own space, where it runs from 0 to +z, to its parent's.
M44d branch_to_parent(double tilt_degrees, double turn_degrees, double scale) {
  return rotation({1, 0, 0}, radians(tilt_degrees)) * rotation({0, 0, 1}, radians(turn_degrees)) *
         M44d().setScale(scale) * M44d().setTranslation(V3d(0, 0, 1));
}

struct Branching {
  M44d first = branch_to_parent(40, 90, 0.65);
  M44d second = branch_to_parent(25, 230, 0.7);
};

void print_branch(NffPrinter& printer, const Branching& branching, const M44d& local_to_world,
                  double thickness, int depth) {
  const double base_radius = 0.15 * thickness;
  const double apex_radius = k_thinning * base_radius;
  const V3d base = V3d(0) * local_to_world, apex = V3d(0, 0, 1) * local_to_world;
  printer.cone({base, base_radius, apex, apex_radius});
  printer.sphere({apex, apex_radius});
  if (depth == 0) return;
  print_branch(printer, branching, branching.first * local_to_world, k_thinning * thickness, depth - 1);
  print_branch(printer, branching, branching.second * local_to_world, k_thinning * thickness, depth - 1);
}

}  // namespace

void print_tree(NffPrinter& printer, const SceneForm& form) {
  printer.background(k_sky);
  printer.view({.from = {4.5, 0.4, 2}, .at = {0, 0, 1.5}, .up = {0, 0, 1}, .angle = 45, .hither = 1});
  for (const V3d& light : {V3d(-5, 5, 50), V3d(30, -30, 30), V3d(-40, -30, 20), V3d(10, 30, 40),
                           V3d(-30, 40, 10), V3d(50, 25, 20), V3d(-10, -60, 30)})
    printer.light(light);

  printer.fill(material({0.2, 0.7, 0.2}, 1, 0, 0, 0, 0));
  printer.polygon(std::array{V3d(50, 50, 0), V3d(-50, 50, 0), V3d(-50, -50, 0), V3d(50, -50, 0)});
  printer.fill(material({0.55, 0.4, 0.2}, 1, 0, 0, 0, 0));
  print_branch(printer, Branching(), M44d(), 1, form.size);
}

}  // namespace farop
