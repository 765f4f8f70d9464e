// SPDX-License-Identifier: GPL-3.0-or-later
// Three closed solids for scan-line algorithms that store an edge with its two faces, after the test objects
// of Lenz Cesar and Ferreira de Oliveira (1995), who give numbers of faces (128, 624, 1992) but no
// dimensions.
#include <array>
#include <cmath>
#include <numbers>

#include "spd/scenes.h"

namespace farop {
namespace {

void print_head(NffPrinter& printer) {
  printer.background({0, 0, 0});
  printer.view({.from = {3.6, -4.8, 3.6},
                .at = V3d(0),
                .up = {0, 0, 1},
                .angle = 45,
                .hither = 1,
                .columns = 400,
                .rows = 600});
  printer.light({1e6, -2e6, 3e6});  // far enough to be directional
  Material grey;
  grey.color = {0.8, 0.8, 0.8};
  printer.fill(grey);
}

struct Direction {
  double cosine, sine;
};

/// Direction of i/n of a turn, wrapped, and exact at quarter turns: equal corners then print alike, and 0 as
/// 0.
Direction turn(int i, int n) {
  constexpr Direction k_quarters[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  i %= n;
  if (4 * i % n == 0) return k_quarters[4 * i / n];
  const double angle = 2 * std::numbers::pi * i / n;
  return {std::cos(angle), std::sin(angle)};
}

constexpr int k_cells = 3;

/// Whether a cell of the 3 x 3 x 3 cube is there: inside the cube and not in the middle column along z.
bool is_solid(const std::array<int, 3>& cell) {
  for (const int k : cell)
    if (k < 0 || k >= k_cells) return false;
  return cell[0] != 1 || cell[1] != 1;
}

/// The side of `cell` towards +axis or -axis, as two triangles, counter-clockwise seen from outside the cell.
void print_cell_side(NffPrinter& printer, const std::array<int, 3>& cell, std::size_t axis, bool positive) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto corner = [&](int du, int dv) {
    std::array<int, 3> k = cell;
    k[axis] += positive ? 1 : 0;
    k[u] += du;
    k[v] += dv;
    const auto at = [](int i) { return (2.0 * i - k_cells) / k_cells; };
    return CornerLine({at(k[0]), at(k[1]), at(k[2])});
  };
  const CornerLine first = corner(0, 0), second = positive ? corner(1, 0) : corner(0, 1);
  const CornerLine third = corner(1, 1), fourth = positive ? corner(0, 1) : corner(1, 0);
  printer.triangle(first, second, third);
  printer.triangle(third, fourth, first);
}

void print_quadrilateral(NffPrinter& printer, const V3d& a, const V3d& b, const V3d& c, const V3d& d) {
  printer.polygon(std::array{a, b, c, d});
}

}  // namespace

void print_hollow_cube(NffPrinter& printer, const SceneForm&) {
  print_head(printer);
  for (int x = 0; x < k_cells; ++x) {
    for (int y = 0; y < k_cells; ++y) {
      for (int z = 0; z < k_cells; ++z) {
        const std::array<int, 3> cell = {x, y, z};
        if (!is_solid(cell)) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          for (const bool positive : {false, true}) {
            std::array<int, 3> neighbour = cell;
            neighbour[axis] += positive ? 1 : -1;
            if (!is_solid(neighbour)) print_cell_side(printer, cell, axis, positive);
          }
        }
      }
    }
  }
}

void print_solid_torus(NffPrinter& printer, const SceneForm&) {
  constexpr int k_ring_steps = 26, k_tube_steps = 24;
  constexpr double k_ring_radius = 1, k_tube_radius = 0.4;
  const auto corner = [](int ring_step, int tube_step) {
    const Direction ring = turn(ring_step, k_ring_steps), tube = turn(tube_step, k_tube_steps);
    const double from_axis = k_ring_radius + k_tube_radius * tube.cosine;
    return V3d(from_axis * ring.cosine, from_axis * ring.sine, k_tube_radius * tube.sine);
  };
  print_head(printer);
  for (int i = 0; i < k_ring_steps; ++i)
    for (int j = 0; j < k_tube_steps; ++j)
      print_quadrilateral(printer, corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
}

void print_solid_cylinder(NffPrinter& printer, const SceneForm&) {
  constexpr int k_columns = 83, k_rows = 22;
  const auto corner = [](int column, int row) {
    const Direction d = turn(column, k_columns);
    return V3d(d.cosine, d.sine, -1 + 2.0 * row / k_rows);
  };
  print_head(printer);
  for (int row = 0; row < k_rows; ++row)
    for (int i = 0; i < k_columns; ++i)
      print_quadrilateral(printer, corner(i, row), corner(i + 1, row), corner(i + 1, row + 1),
                          corner(i, row + 1));
  for (int i = 0; i < k_columns; ++i)
    printer.polygon(std::array{V3d(0, 0, 1), corner(i, k_rows), corner(i + 1, k_rows)});
  for (int i = 0; i < k_columns; ++i)
    printer.polygon(std::array{V3d(0, 0, -1), corner(i + 1, 0), corner(i, 0)});
}

}  // namespace farop
