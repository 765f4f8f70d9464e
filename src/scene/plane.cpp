// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/plane.h"

#include <algorithm>
#include <cmath>

namespace farop {

std::optional<V3d> plane_normal(std::span<const V3d> positions, std::span<const std::uint32_t> corners) {
  // Relative to the first corner: far from the origin the products would otherwise cancel. Scaled by the
  // extent: the test is free of units, and squares of huge or tiny coordinates neither overflow nor vanish.
  const V3d& origin = positions[corners.front()];
  double extent = 0;
  for (const std::uint32_t c : corners) {
    const V3d d = positions[c] - origin;
    extent = std::max({extent, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  }
  if (!(extent > 0) || !std::isfinite(extent)) return std::nullopt;
  V3d sum(0, 0, 0);
  V3d previous = (positions[corners.back()] - origin) / extent;
  for (const std::uint32_t c : corners) {
    const V3d current = (positions[c] - origin) / extent;
    sum.x += (previous.y - current.y) * (previous.z + current.z);
    sum.y += (previous.z - current.z) * (previous.x + current.x);
    sum.z += (previous.x - current.x) * (previous.y + current.y);
    previous = current;
  }
  const double length = sum.length();
  if (!(length > 1e-12)) return std::nullopt;
  return sum / length;
}

void average_normals(Surface& surface) {
  surface.averaged_normals.assign(surface.positions.size(), V3d(0, 0, 0));
  for (const PolygonView polygon : surface.polygons) {
    const std::optional<V3d> normal = plane_normal(surface.positions, polygon.corners);
    if (!normal) continue;
    for (const std::uint32_t c : polygon.corners) surface.averaged_normals[c] += *normal;
  }
  for (V3d& n : surface.averaged_normals) n.normalize();  // a zero sum stays zero
}

}  // namespace farop
