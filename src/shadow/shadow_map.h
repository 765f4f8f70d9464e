// SPDX-License-Identifier: GPL-3.0-or-later
// Shadows of spot lights by depth maps, as SIPP has them: a picture of the scene taken from the light tells
// how far its rays come.
//
// Only spots have a map; point and directional lights have no direction to take one in.
// Sources: L. Williams, "Casting Curved Shadows on Curved Surfaces", SIGGRAPH 1978; W. Reeves, D. Salesin, R.
// Cook, "Rendering Antialiased Shadows with Depth Maps", SIGGRAPH 1987 (percentage-closer filtering).
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "geometry/pipeline.h"
#include "scene/scene.h"
#include "shading/light.h"

namespace farop {

/// Random offsets of the samples of a lookup, shared by the maps of a frame.
struct ShadowJitter {
  /// Draws 256 numbers 0 <= u < 1.
  explicit ShadowJitter(const std::function<double()>& uniform);
  std::array<double, 256> offsets{};
};

/// Depths as seen from one spot. World space.
class ShadowMap : public LightShadow {
 public:
  /// Draws the scene's polygons as they are now, both sides of them, all opaque, from `light` towards its
  /// target: light.shadow_size texels a side (limited to 1 .. k_max_shadow_size, core/limits.h), the cone's
  /// opening (limited to 179 degrees) across. No shader is called. The scene is tessellated. A light at its
  /// own target gets no map: everything is lit. Throws Error(surroundings) when memory runs out.
  ShadowMap(const Scene& scene, const Light& light, std::shared_ptr<const ShadowJitter> jitter);

  /// Percentage-closer filtering: of n x n samples, one jittered within each part of a box of half width
  /// 0.002 texels times the map's size, the share whose map depth is not nearer to the light than the point
  /// by more than 0.005 times the distance from light to target. n = floor(2 * half width + 0.5), at least 1.
  /// What lies outside the map is lit. Depends on the point alone.
  double unshadowed(const V3d& point) const override;

 private:
  bool hidden(double column, double row, double depth) const;

  std::shared_ptr<const ShadowJitter> jitter_;
  M44d world_to_light_;  ///< eye space of the light: z along its axis
  double scale_ = 0;     ///< column = center + scale x / z
  double center_ = 0;
  double bias_ = 0;
  int size_ = 0;               ///< 0: no map
  std::vector<float> depths_;  ///< z of the nearest surface, row by row from the bottom; infinite without one
};

/// `shadow`, which expects world coordinates, for points of another space.
class MovedShadow : public LightShadow {
 public:
  MovedShadow(std::shared_ptr<const LightShadow> shadow, const M44d& to_world)
      : shadow_(std::move(shadow)), to_world_(to_world) {}
  double unshadowed(const V3d& point) const override { return shadow_->unshadowed(point * to_world_); }

 private:
  std::shared_ptr<const LightShadow> shadow_;
  M44d to_world_;
};

/// True for a light that cast_shadows() would give a map.
bool casts_shadows(const Light& light);

/// Gives every active spot that casts shadows a new map, in the lights of `setup` (from prepare_geometry with
/// the same scene). Draws 256 numbers from `uniform` if there is any such light, as SIPP does before it looks
/// at noise. Returns the number of maps. Throws Error(input) when the maps together would have more than
/// k_max_shadow_texels texels, and what ShadowMap throws.
int cast_shadows(const Scene& scene, GeometrySetup& setup, const std::function<double()>& uniform);

}  // namespace farop
