// SPDX-License-Identifier: GPL-3.0-or-later
// nurbtst: one bicubic B-spline patch, basis functions by the recurrence of de Boor and Cox.
//
// Parameters and basis functions are in single precision, as published: 0.08f added up 25 times ends just
// behind the last knot, and the grid's outermost points show it.
#include <array>
#include <cstddef>
#include <span>

#include "spd/scenes.h"

namespace farop {
namespace {

constexpr std::size_t k_order = 4;
constexpr std::size_t k_rows = 6, k_columns = 5;
constexpr std::size_t k_row_steps = 30, k_column_steps = 25;
constexpr std::array<float, k_rows + k_order> k_row_knots = {0, 0, 0, 0, 1, 2, 3, 3, 3, 3};
constexpr std::array<float, k_columns + k_order> k_column_knots = {0, 0, 0, 0, 1, 2, 2, 2, 2};
/// Height of control point (row, column); its other two coordinates are the column and the row.
constexpr double k_heights[k_rows][k_columns] = {{0, 3, -3, 3, 0}, {0, 0, 0, 0, 0}, {0, 0, 5, 0, 0},
                                                 {0, 0, 5, 0, 0},  {0, 0, 0, 0, 0}, {0, -3, 3, -3, 0}};

constexpr std::size_t k_most_knots = k_row_knots.size();

/// Values and derivatives of all basis functions at one parameter; those beyond the control points are not
/// used.
struct Basis {
  std::array<float, k_most_knots> value{}, derivative{};
};

/// numerator / denominator, 0 for a basis function that is 0 (its knots may coincide).
float value_term(float factor, float numerator, float denominator) {
  return factor == 0 ? 0 : numerator / denominator;
}
float derivative_term(float factor, float numerator, float denominator) {
  if (factor == 0) return 0;
  return numerator == 0 && denominator == 0 ? 1 : numerator / denominator;
}

Basis evaluate_basis(std::span<const float> knots, float t) {
  const std::size_t points = knots.size() - k_order;
  Basis basis;
  auto& [b, d] = basis;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) b[i] = knots[i] <= t && t < knots[i + 1] ? 1.0f : 0.0f;
  if (t >= knots.back()) b[points - 1] = 1;

  for (std::size_t k = 2; k <= k_order; ++k) {
    for (std::size_t i = 0; i + k < knots.size(); ++i) {
      const float left = knots[i + k - 1] - knots[i], right = knots[i + k] - knots[i + 1];
      const float from_left = t - knots[i], to_right = knots[i + k] - t;
      const float derivative = derivative_term(b[i], b[i], left) -
                               derivative_term(b[i + 1], b[i + 1], right) +
                               derivative_term(d[i], from_left * d[i], left) +
                               derivative_term(d[i + 1], to_right * d[i + 1], right);
      b[i] = value_term(b[i], from_left * b[i], left) + value_term(b[i + 1], to_right * b[i + 1], right);
      d[i] = derivative;
    }
  }
  return basis;
}

/// Basis functions at 0, step, 2 step, ..., the parameter added up in single precision.
template <std::size_t Steps>
std::array<Basis, Steps + 1> basis_along(std::span<const float> knots, float step) {
  std::array<Basis, Steps + 1> along;
  float t = 0;
  for (Basis& basis : along) {
    basis = evaluate_basis(knots, t);
    t += step;
  }
  return along;
}

using BasisValues = std::array<float, k_most_knots>;

V3d weighted_sum(const BasisValues& rows, const BasisValues& columns) {
  V3d sum(0);
  for (std::size_t a = 0; a < k_rows; ++a) {
    for (std::size_t b = 0; b < k_columns; ++b) {
      const float weight = rows[a] * columns[b];
      sum +=
          V3d(static_cast<double>(b), static_cast<double>(a), k_heights[a][b]) * static_cast<double>(weight);
    }
  }
  return sum;
}

}  // namespace

void print_nurbtst(NffPrinter& printer, const SceneForm&) {
  printer.background({0, 0, 0});
  printer.view({.from = {0, 5, -10},
                .at = V3d(0),
                .up = {0, 1, 0},
                .angle = 30,
                .hither = 0.001,
                .columns = 256,
                .rows = 256});
  printer.light({0, 50, -10});
  printer.fill(material({1, 0, 0}, 0.7, 0, 10, 0, 1));

  const auto u = basis_along<k_row_steps>(k_row_knots, 0.1f);
  const auto v = basis_along<k_column_steps>(k_column_knots, 0.08f);
  const M44d turn = rotation({1, 0, 0}, radians(-90)) * rotation({0, 1, 0}, radians(30));
  const M44d placement = M44d().setTranslation(V3d(-2, -2.5, 0)) * turn;
  const auto point = [&](std::size_t i, std::size_t j) {
    const V3d along_u = weighted_sum(u[i].derivative, v[j].value);
    const V3d along_v = weighted_sum(u[i].value, v[j].derivative);
    return TessellationCorner{weighted_sum(u[i].value, v[j].value) * placement,
                              along_v.cross(along_u).normalized() * turn};
  };
  for (std::size_t i = 0; i < k_row_steps; ++i) {
    for (std::size_t j = 0; j < k_column_steps; ++j) {
      printer.patch({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
      printer.patch({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
    }
  }
}

}  // namespace farop
