// SPDX-License-Identifier: GPL-3.0-or-later
// SIPP's primitives, polygon by polygon as SIPP 3.1 makes them.
//
// Every function returns a new object with the identity matrix, or nullptr: for a resolution below 1, sizes
// that are not finite, and where a function says so. All throw Error(ExitStatus::input) before
// anything is made when there would be more than ShapeLook::max_polygons polygons.
// Surfaces have their polygons in SIPP's list order (the reverse of the order in which they are made).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/math.h"
#include "scene/scene.h"

namespace farop::sipp {

/// Texture coordinates of primitives; the numbers are SIPP's. world: the position at creation.
enum class TextureMapping { world = 0, cylindrical = 1, spherical = 2, natural = 3 };

/// What the polygons of a shape get.
struct ShapeLook {
  std::shared_ptr<const Shader> shader;  ///< nullptr: a plain material, for callers that bind shaders later
  TextureMapping texture = TextureMapping::world;
  std::uint64_t max_polygons = 50'000'000;
};

/// Axis z. `around_ring` x `around_tube` quadrilaterals in one surface.
std::shared_ptr<Object> torus(double big_radius, double small_radius, int around_ring, int around_tube,
                              const ShapeLook& look);

/// Poles on z; an odd resolution is raised by one. One surface: caps of triangles, bands of quadrilaterals.
std::shared_ptr<Object> ellipsoid(const V3d& radii, int resolution, const ShapeLook& look);
std::shared_ptr<Object> sphere(double radius, int resolution, const ShapeLook& look);

/// Centred, axis z. Up to three surfaces: bottom cap, top cap, side. nullptr for a negative radius and for
/// two of 0.
std::shared_ptr<Object> cone(double bottom_radius, double top_radius, double length, int resolution,
                             const ShapeLook& look);
std::shared_ptr<Object> cylinder(double radius, double length, int resolution, const ShapeLook& look);

/// Centred in z. `outline` counter-clockwise seen from +z, convex or concave, at least 3 points (else
/// nullptr). Each of the n + 2 faces is a surface of its own: top, bottom, sides.
std::shared_ptr<Object> prism(std::span<const V2d> outline, double length, const ShapeLook& look);
std::shared_ptr<Object> block(const V3d& size, const ShapeLook& look);
std::shared_ptr<Object> cube(double size, const ShapeLook& look);

/// Control points, and for each patch 16 indices into them from 0 (four rows of four), for each curve four
/// (so patches.size() is a multiple of 16). nullptr also without any and for indices out of range.
/// resolution^2 quadrilaterals a patch, all in one surface.
std::shared_ptr<Object> bezier_patches(std::span<const V3d> points, std::span<const int> patches,
                                       int resolution, const ShapeLook& look);
/// Every curve is revolved about the z axis in 4 * resolution steps.
std::shared_ptr<Object> bezier_rotcurves(std::span<const V3d> points, std::span<const int> curves,
                                         int resolution, const ShapeLook& look);

/// Sub-objects: body, lid, spout, handle. Bottom at z = 0, height 0.75, spout towards +x, no bottom plate.
/// Source of the shape: M. Newell, "The Utilization of Procedure Models in Digital Image Synthesis", PhD
/// thesis, University of Utah, 1975.
std::shared_ptr<Object> teapot(int resolution, const ShapeLook& look);
std::shared_ptr<Object> teapot_body(int resolution, const ShapeLook& look);
std::shared_ptr<Object> teapot_lid(int resolution, const ShapeLook& look);
std::shared_ptr<Object> teapot_spout(int resolution, const ShapeLook& look);
std::shared_ptr<Object> teapot_handle(int resolution, const ShapeLook& look);

/// alpha <= 0: superellipsoid, > 0: toroid. Exponents n, e >= 0.1 (smaller ones are raised to it). 17 x 17
/// quadrilaterals whose last row and column lie on the first.
/// Source: A. Barr, "Superquadrics and Angle-Preserving Transformations", IEEE CG&A 1(1), 1981.
std::shared_ptr<Object> superquadric(const V3d& radii, double n, double e, double alpha,
                                     const ShapeLook& look);

}  // namespace farop::sipp
