// SPDX-License-Identifier: GPL-3.0-or-later
// teapot: Newell's teapot on a checkerboard.
#include <algorithm>
#include <array>
#include <cmath>

#include "spd/scenes.h"
#include "spd/teapot_patches.h"

namespace farop {
namespace {

using Weights = std::array<double, 4>;

/// Cubic Bernstein polynomials and their derivatives.
Weights bernstein(double t) {
  const double u = 1 - t;
  return {u * u * u, 3 * t * u * u, 3 * t * t * u, t * t * t};
}
Weights bernstein_derivative(double t) {
  const double u = 1 - t;
  return {-3 * u * u, 3 * u * u - 6 * t * u, 6 * t * u - 3 * t * t, 3 * t * t};
}

using ControlNet = std::array<std::uint16_t, 16>;

/// Sum over the net; its rows belong to s, its columns to t.
V3d weighted_sum(const ControlNet& net, const Weights& s, const Weights& t) {
  V3d sum(0);
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      sum += k_teapot_points[net[4 * row + column]] * (s[row] * t[column]);
  return sum;
}

TessellationCorner evaluate(const ControlNet& net, double s, double t) {
  const V3d along_t = weighted_sum(net, bernstein(s), bernstein_derivative(t));
  const V3d along_s = weighted_sum(net, bernstein_derivative(s), bernstein(t));
  return {weighted_sum(net, bernstein(s), bernstein(t)), along_t.cross(along_s).normalized()};
}

/// At the middles of lid and bottom patches run to a point, where normals are noise: a triangle with an edge
/// there vanishes, one with a corner there gets the normal straight up or down.
void print_triangle(NffPrinter& printer, const TessellationCorner& a, const TessellationCorner& b,
                    const TessellationCorner& c) {
  const auto at_cusp = [](const TessellationCorner& corner) {
    return std::abs(corner.position.x) <= 1e-4 && std::abs(corner.position.y) <= 1e-4;
  };
  TessellationCorner triangle[3] = {a, b, c};
  const auto cusps = std::ranges::count_if(triangle, at_cusp);
  if (cusps >= 2) return;
  if (cusps == 1) {
    TessellationCorner& corner = *std::ranges::find_if(triangle, at_cusp);
    corner.normal = V3d(0, 0, corner.position.z > 1.5 ? 1 : -1);
  }
  printer.patch(triangle);
}

void print_patch(NffPrinter& printer, const ControlNet& net, int steps) {
  const double n = steps;
  for (int s = 0; s < steps; ++s) {
    for (int t = 0; t < steps; ++t) {
      const TessellationCorner q0 = evaluate(net, s / n, t / n), q1 = evaluate(net, s / n, (t + 1) / n);
      const TessellationCorner q2 = evaluate(net, (s + 1) / n, (t + 1) / n),
                               q3 = evaluate(net, (s + 1) / n, t / n);
      print_triangle(printer, q0, q1, q2);
      print_triangle(printer, q2, q3, q0);
    }
  }
}

/// The squares whose row and column add up to an odd or even number.
void print_squares(NffPrinter& printer, int squares, int parity) {
  const auto at = [squares](int k) { return 4 * (2.0 * k / squares - 1); };
  for (int s = 0; s < squares; ++s) {
    for (int t = 0; t < squares; ++t) {
      if ((s + t) % 2 != parity) continue;
      printer.polygon(std::array{V3d(at(s), at(t), 0), V3d(at(s + 1), at(t), 0), V3d(at(s + 1), at(t + 1), 0),
                                 V3d(at(s), at(t + 1), 0)});
    }
  }
}

}  // namespace

void print_teapot(NffPrinter& printer, const SceneForm& form) {
  printer.background(k_sky);
  printer.view({.from = {4.86, 7.2, 5.4}, .at = V3d(0), .up = {0, 0, 1}, .angle = 45, .hither = 1});
  for (const V3d& light : {V3d(-3.1, 9.8, 12.1), V3d(11.3, 5.1, 8.8)}) printer.light(light);

  printer.fill(material({1, 1, 1}, 0.5, 0.5, 30, 0, 0));
  print_squares(printer, form.size, 1);
  printer.fill(material({0.5, 0.5, 0.5}, 0.5, 0.5, 30, 0, 0));
  print_squares(printer, form.size, 0);

  printer.fill(material({1, 0.5, 0.1}, 0.75, 0.25, 37, 0, 0));
  for (const ControlNet& net : k_teapot_patches) print_patch(printer, net, form.size);
}

}  // namespace farop
