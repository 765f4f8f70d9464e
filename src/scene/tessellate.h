// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces spheres and cones by polygons: the end of loading.
//
// Construction, order and normals are those of the Standard Procedural Databases (E. Haines, "A Proposal for
// Standard Graphics Environments", IEEE CG&A 7(11), 1987; SPD 3.14), so that counts match other programs: 12
// R^2 triangles a sphere, 8 R a cone, each corner with its normal, like NFF `pp`.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "scene/scene.h"

namespace farop {

/// One triangle corner: position and unit normal, in the primitive's own coordinates.
struct TessellationCorner {
  V3d position, normal;
};
/// Receives the triangles in order, counter-clockwise seen from outside (from inside for inside_visible
/// primitives, normals then point inwards).
using TriangleFunction = std::function<void(const TessellationCorner (&triangle)[3])>;

/// Largest resolution: 12.6 million triangles a sphere, some 400 MB; finer than any picture that can be
/// drawn.
constexpr int k_max_detail = 1024;

/// resolution  R, 1..k_max_detail
/// Equal primitives give equal triangles bit for bit, and so do the corners that neighbouring triangles
/// share: after merging equal vertices a sphere is closed, a cone or cylinder is open at its two ends only. A
/// pointed cone (radius 0) has 4 R triangles without area at its point.
void tessellate(const Sphere& sphere, int resolution, const TriangleFunction& emit);
void tessellate(const Cone& cone, int resolution, const TriangleFunction& emit);

/// The viewpoint that `--detail auto` looks round for.
struct DetailView {
  V3d eye;
  double vertical_tangent = 0;  ///< half height of the picture at distance 1
  int rows = 0;                 ///< rows drawn: YRES times the degree of super-sampling
};

/// `--detail`: a fixed resolution R >= 1; 0 leaves curved primitives out (counted as skipped); nothing =
/// auto: for each primitive R = clamp(ceil(0.785 sqrt(p)), 1, 64), p its radius in pixels, so that a
/// silhouette is off by half a pixel at most; 3 without a camera.
struct Detail {
  std::optional<int> fixed;
  std::optional<DetailView> view;
};

/// R of `auto` for a primitive in world space: p = r (H-1) / (2 t max(D - r, r/16)) with r the (larger)
/// radius, D the distance of the eye from the centre or the axis segment, H the rows, t the vertical tangent.
int auto_resolution(const Sphere& sphere, const DetailView& view);
int auto_resolution(const Cone& cone, const DetailView& view);

/// Some 10 GB of triangles: a small hostile file of spheres around the eye must not fill the memory.
constexpr std::uint64_t k_max_tessellated_triangles = 250'000'000;

/// Tessellates in place, keeping the order of primitives and polygons and merging vertices as everywhere.
/// Local radii and positions are taken to world space for `auto`. A surface that is placed several times
/// stays shared and is tessellated once, with the largest resolution that one of its placements asks for;
/// skipped primitives count once per placement, as polygons do. Memory: one surface at a time exists twice.
void tessellate_scene(Scene& scene, const Detail& detail);

}  // namespace farop
