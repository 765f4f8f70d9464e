// SPDX-License-Identifier: GPL-3.0-or-later
// Any ring of lattice points, most of which cross themselves: n - 2 triangles over its corners, whose
// signed areas add up to the ring's. Two bytes make a corner, so that corners and edges often coincide.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "geometry/triangulate.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t k_max_corners = 400;
  std::vector<farop::V3d> corners;
  for (std::size_t i = 0; i + 1 < size && corners.size() < k_max_corners; i += 2) {
    corners.emplace_back(data[i], data[i + 1], 0);
  }
  farop::TriangulateScratch scratch;
  std::vector<farop::CornerTriangle> triangles;
  farop::triangulate(corners, farop::V3d(0, 0, 1), triangles, scratch);
  if (corners.size() < 3) return triangles.empty() ? 0 : (std::abort(), 0);
  if (triangles.size() + 2 != corners.size()) std::abort();

  const auto doubled_area = [&](std::size_t a, std::size_t b, std::size_t c) {
    return (corners[b] - corners[a]).cross(corners[c] - corners[a]).z;  // exact: whole numbers below 2^17
  };
  double ring_area = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) ring_area += doubled_area(0, i, i + 1);
  double area = 0;
  for (const auto& [a, b, c] : triangles) {
    if (a >= corners.size() || b >= corners.size() || c >= corners.size()) std::abort();
    area += doubled_area(a, b, c);
  }
  if (area != ring_area) std::abort();
  return 0;
}
