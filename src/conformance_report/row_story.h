// SPDX-License-Identifier: GPL-3.0-or-later
// One row of one polygon under the fill rule lb: where it is crossed, and which samples that makes inside.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/screen_polygon.h"

namespace farop::conformance_report {

/// x = numerator / denominator, in lowest terms; denominator > 0. `from` is the edge's lower end.
struct Crossing {
  std::int64_t numerator = 0, denominator = 1;
  ScreenVertex from, to;
};

/// Crossings of row y by edges with ymin <= y < ymax, from left to right; horizontal edges never count. Exact
/// for coordinates below 2^30 in size.
std::vector<Crossing> crossings(std::span<const ScreenVertex> polygon, int y);
/// How many of them lie at or left of x: odd means covered.
int crossings_up_to(std::span<const Crossing> row, int x);
/// What the side of an edge is decided by, with the numbers put in; counted where value >= 0.
struct EdgeSum {
  std::int64_t value = 0;  ///< (x - x1)(y2 - y1) - (y - y1)(x2 - x1)
  std::string text;        ///< "(5 − 1)·7 − (3 − 1)·(−2) = 32"
};
EdgeSum edge_sum(const Crossing& edge, int x, int y);
/// "12/7 = 1.71", or "3"; in lowest terms.
std::string fraction(std::int64_t numerator, std::int64_t denominator);

}  // namespace farop::conformance_report
