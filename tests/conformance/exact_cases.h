// SPDX-License-Identifier: GPL-3.0-or-later
// What a rasterizer must draw, by brute force straight from the definitions: the checker's own code has no
// part in it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plugins/plugin_cases.h"

namespace farop::test {

/// A picture of 0 and 1, row by row from the bottom.
using Coverage = std::vector<std::uint8_t>;

/// Samples that move by (+-a, +-b), a and b tiny, lie on no edge; what the parity of a half-line to the left
/// says of them is a fill rule without gaps and overlaps. Upper case: b is much smaller than a; lower case:
/// much larger.
struct MovedSample {
  int x, y;          ///< signs of the move
  bool x_dominates;  ///< a >> b
};
constexpr MovedSample k_lb{+1, +1, true};

/// By exact integers, for coordinates below 1000.
Coverage moved_coverage(const Corners& corners, const MovedSample& rule, int width, int height);

/// Interior and boundary; interior without boundary.
Coverage closed_coverage(const Corners& corners, int width, int height);
Coverage open_coverage(const Corners& corners, int width, int height);

/// The exact value of an attribute that is affine over the polygon (triangles; planar n-gons), times a
/// denominator > 0.
struct ExactAffine {
  Int128 a = 0, b = 0, c = 0, denominator = 1;  ///< (a x + b y + c) / denominator

  /// Nothing for corners on one line.
  static std::optional<ExactAffine> through(const Corners& corners, Attribute attribute);
  /// out - exact value at (x, y).
  double error(std::int64_t out, int x, int y) const;
};

std::string text_of(const Corners& corners);

}  // namespace farop::test
