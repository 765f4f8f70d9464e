// SPDX-License-Identifier: GPL-3.0-or-later
// Bicubic Bezier patches, revolved cubic Bezier curves, and the teapot made of both.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "parse_sipp/shape_builder_internal.h"

namespace farop::sipp {
namespace {

/// Cubic Bernstein polynomials; what is below 1e-15 counts as 0.
std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  std::array<double, 4> b = {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
  for (double& v : b) {
    if (std::abs(v) < 1e-15) v = 0;
  }
  return b;
}

bool usable(std::span<const V3d> points, std::span<const int> indices, std::size_t group, int resolution) {
  if (resolution < 1 || indices.empty() || indices.size() % group != 0) return false;
  for (const V3d& p : points) {
    if (!all_finite({p.x, p.y, p.z})) return false;
  }
  return std::all_of(indices.begin(), indices.end(),
                     [&](int i) { return i >= 0 && static_cast<std::size_t>(i) < points.size(); });
}

}  // namespace

std::shared_ptr<Object> bezier_patches(std::span<const V3d> points, std::span<const int> patches,
                                       int resolution, const ShapeLook& look) {
  if (!usable(points, patches, 16, resolution)) return nullptr;
  const double patch_count = static_cast<double>(patches.size()) / 16;
  ShapeBuilder shape("set of Bezier patches", patch_count * resolution * resolution, look);
  const auto side = static_cast<std::size_t>(resolution) + 1;
  const double step = 1.0 / resolution;
  std::vector<std::array<double, 4>> weights;
  for (std::size_t i = 0; i < side; ++i) weights.push_back(bernstein(static_cast<double>(i) * step));

  for (std::size_t first = 0; first < patches.size(); first += 16) {
    const auto point = [&](std::size_t v, std::size_t u) {
      V3d sum(0, 0, 0);
      for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
          const auto index = static_cast<std::size_t>(patches[first + 4 * row + column]);
          sum += points[index] * (weights[v][row] * weights[u][column]);
        }
      }
      return ShapeBuilder::Corner{sum, V3d(static_cast<double>(u) * step, static_cast<double>(v) * step, 0)};
    };
    std::vector<ShapeBuilder::Corner> low, high;  // two neighbouring rows of constant v
    for (std::size_t u = 0; u < side; ++u) low.push_back(point(0, u));
    for (std::size_t v = 1; v < side; ++v) {
      high.clear();
      for (std::size_t u = 0; u < side; ++u) high.push_back(point(v, u));
      for (std::size_t u = 1; u < side; ++u) shape.polygon({low[u - 1], low[u], high[u], high[u - 1]});
      std::swap(low, high);
    }
  }
  shape.end_surface();
  return shape.take();
}

std::shared_ptr<Object> bezier_rotcurves(std::span<const V3d> points, std::span<const int> curves,
                                         int resolution, const ShapeLook& look) {
  if (!usable(points, curves, 4, resolution)) return nullptr;
  const double curve_count = static_cast<double>(curves.size()) / 4;
  ShapeBuilder shape("set of rotational curves", curve_count * 4 * resolution * resolution, look);
  const int around = 4 * resolution;
  const double angle = 2 * k_pi / around;
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](const V3d& p) { return V3d(p.x * c - p.y * s, p.x * s + p.y * c, p.z); };
  const double step = 1.0 / resolution;

  for (std::size_t first = 0; first < curves.size(); first += 4) {
    const auto point = [&](double t) {
      const std::array<double, 4> weights = bernstein(t);
      V3d sum(0, 0, 0);
      for (std::size_t i = 0; i < 4; ++i) {
        sum += points[static_cast<std::size_t>(curves[first + i])] * weights[i];
      }
      return sum;
    };
    double t = 0;  // step by step, as SIPP does
    for (int i = 0; i < resolution; ++i) {
      const double next_t = t + step;
      const V3d first0 = point(t), first1 = point(next_t);
      V3d p0 = first0, p1 = first1;
      for (int k = 0; k < around; ++k) {
        // The last step ends where the first began, so that a seam of textures leaves no gap.
        const bool last = k + 1 == around;
        const V3d p3 = last ? first0 : turned(p0), p2 = last ? first1 : turned(p1);
        const double u = static_cast<double>(k) / around, next_u = static_cast<double>(k + 1) / around;
        shape.polygon({{p0, V3d(u, t, 0)},
                       {p3, V3d(next_u, t, 0)},
                       {p2, V3d(next_u, next_t, 0)},
                       {p1, V3d(u, next_t, 0)}});
        p0 = p3;
        p1 = p2;
      }
      t = next_t;
    }
  }
  shape.end_surface();
  return shape.take();
}

}  // namespace farop::sipp
