// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

#include <cmath>
#include <cstddef>
#include <limits>

namespace farop {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Twice the area by the shoelace formula, relative to the first corner. `Number` decides how exact it is.
template <typename Number>
Number doubled_area(std::span<const V2d> ring) {
  const Number x0(ring[0].x);
  const Number y0(ring[0].y);
  Number sum(0);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const V2d& a = ring[i];
    const V2d& b = ring[i + 1];
    sum += (Number(a.x) - x0) * (Number(b.y) - y0) - (Number(b.x) - x0) * (Number(a.y) - y0);
  }
  return sum;
}

/// A bound on the rounding error of doubled_area<double>.
double doubled_area_error(std::span<const V2d> ring) {
  double products = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const V2d a = ring[i] - ring[0];
    const V2d b = ring[i + 1] - ring[0];
    products += std::abs(a.x * b.y) + std::abs(b.x * a.y);
  }
  // Each product carries three roundings and passes through at most one addition per corner; twice that for
  // the error of this sum itself. The last term covers products that underflow.
  const double corners = static_cast<double>(ring.size());
  return 2 * (corners + 4) *
         (products * std::numeric_limits<double>::epsilon() + std::numeric_limits<double>::min());
}

}  // namespace

int orientation(const V2d& a, const V2d& b, const V2d& c) {
  return CGAL::orientation(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y), Kernel::Point_2(c.x, c.y));
}

int area_sign(std::span<const V2d> ring) {
  if (ring.size() < 3) return 0;
  const double area = doubled_area<double>(ring);
  if (std::isfinite(area) && std::abs(area) > doubled_area_error(ring)) return area > 0 ? 1 : -1;
  return CGAL::sign(doubled_area<CGAL::Exact_rational>(ring));
}

}  // namespace farop
