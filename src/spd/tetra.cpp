// SPDX-License-Identifier: GPL-3.0-or-later
// tetra: the recursive tetrahedron of Sierpinski.
#include <array>

#include "spd/scenes.h"

namespace farop {
namespace {

constexpr std::size_t k_faces[4][3] = {{0, 1, 2}, {3, 2, 1}, {2, 3, 0}, {1, 0, 3}};

/// Tetrahedron with its corners at every other corner of the cube `center` +- `half_width`.
void print_tetrahedron(NffPrinter& printer, int depth, const V3d& center, double half_width) {
  const V3d corner_signs[4] = {{-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}, {1, 1, 1}};
  if (depth > 1) {
    for (const V3d& signs : corner_signs)
      print_tetrahedron(printer, depth - 1, center + signs * (half_width / 2), half_width / 2);
    return;
  }
  const auto line = [&](std::size_t i) { return CornerLine(center + corner_signs[i] * half_width); };
  const std::array<CornerLine, 4> corners = {line(0), line(1), line(2), line(3)};
  for (const auto& face : k_faces) printer.triangle(corners[face[0]], corners[face[1]], corners[face[2]]);
}

}  // namespace

void print_tetra(NffPrinter& printer, const SceneForm& form) {
  printer.background(k_sky);
  printer.view({.from = {1.022846, -3.177154, -2.174512},
                .at = {-0.004103, -0.004103, 0.216539},
                .up = {-0.816497, -0.816497, 0.816497},
                .angle = 45,
                .hither = 1});
  printer.light({2, -18, -5});
  printer.fill(material({1, 0.2, 0.2}, 1, 0, 0, 0, 0));
  print_tetrahedron(printer, form.size, V3d(0), 1);
}

}  // namespace farop
