// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/sipp_transform.h"

#include <cmath>

namespace farop::sipp {
namespace {

double without_dust(double v) {
  return std::abs(v) < 1e-15 ? 0 : v;
}

/// Turns columns `a` and `b`: a' = a cos - b sin, b' = a sin + b cos.
void rotate_columns(M44d& m, int a, int b, double angle) {
  const double c = without_dust(std::cos(angle)), s = without_dust(std::sin(angle));
  for (int row = 0; row < 4; ++row) {
    const double va = m[row][a], vb = m[row][b];
    m[row][a] = va * c - vb * s;
    m[row][b] = va * s + vb * c;
  }
}

}  // namespace

void translate(M44d& matrix, const V3d& by) {
  for (int column = 0; column < 3; ++column) matrix[3][column] += by[column];
}

void scale(M44d& matrix, const V3d& factors) {
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 3; ++column) matrix[row][column] *= factors[column];
  }
}

void rotate_x(M44d& matrix, double angle) {
  rotate_columns(matrix, 1, 2, angle);
}

void rotate_y(M44d& matrix, double angle) {
  rotate_columns(matrix, 2, 0, angle);
}

void rotate_z(M44d& matrix, double angle) {
  rotate_columns(matrix, 0, 1, angle);
}

void rotate(M44d& matrix, const V3d& point, const V3d& direction, double angle) {
  const double azimuth = std::atan2(direction.y, direction.x);
  const double polar = std::atan2(std::hypot(direction.x, direction.y), direction.z);
  translate(matrix, -point);
  rotate_z(matrix, -azimuth);
  rotate_y(matrix, -polar);
  rotate_z(matrix, angle);
  rotate_y(matrix, polar);
  rotate_z(matrix, azimuth);
  translate(matrix, point);
}

void mirror(M44d& matrix, const V3d& point, const V3d& normal) {
  const V3d n = normal.normalized();
  translate(matrix, -point);
  for (int row = 0; row < 4; ++row) {
    const V3d v(matrix[row][0], matrix[row][1], matrix[row][2]);
    const V3d mirrored = v - n * (2 * v.dot(n));
    for (int column = 0; column < 3; ++column) matrix[row][column] = mirrored[column];
  }
  translate(matrix, point);
}

void transform(M44d& matrix, const M44d& by) {
  matrix = matrix * by;
}

}  // namespace farop::sipp
