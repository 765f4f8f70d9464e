// SPDX-License-Identifier: GPL-3.0-or-later
// Light sources as shaders meet them: a direction and a fraction at every point.
#pragma once

#include <memory>
#include <vector>

#include "core/color.h"
#include "core/math.h"

namespace farop {

class NoiseTable;

/// Point: at a place, as strong far away as near. Directional: infinitely far. Spots: point lights with a
/// cone; a sharp one is equally strong inside it, a soft one fades from the axis to nothing at the border.
enum class LightKind { point, directional, spot_sharp, spot_soft };

/// How much of a light arrives: what stands between. Space: that of the LightSource that holds it.
class LightShadow {
 public:
  virtual ~LightShadow() = default;
  /// Fraction of the light that reaches `point`, 0..1.
  virtual double unshadowed(const V3d& point) const = 0;
};

/// A light in the space of the positions it is used with; `color` includes the intensity and may exceed 1.
struct LightSource {
  V3d position{0, 0, 0};  ///< of a directional one: unit vector from the scene TO the light
  Rgb color{1, 1, 1};
  LightKind kind = LightKind::point;
  V3d axis{0, 0, 1};          ///< spots: unit vector from the light along the middle of its cone
  double cos_half_angle = 0;  ///< spots: cosine of half the opening of the cone
  std::shared_ptr<const LightShadow> shadow = nullptr;  ///< nullptr: nothing stands in the way
};

/// What one light does at one point.
struct Illumination {
  V3d to_light{0, 0, 0};  ///< unit vector; zero where the point is the light itself
  double fraction = 0;    ///< 0..1: cone and shadow; there is no attenuation by distance
};

/// SIPP 3.1's light model. With k = cosine of the angle between the axis and the direction to the point: a
/// sharp spot is 1 for k >= cos_half_angle, a soft one 1/2 + 1/2 cos(pi (1 - k) / (1 - cos_half_angle)) for k
/// > 0 as well; both times the shadow's fraction.
Illumination illuminate(const LightSource& light, const V3d& point);

/// What shaders of a frame share. Eye space: origin at the eye, x right, y up, z along the view direction.
struct ShadingFrame {
  std::vector<LightSource> lights;                    ///< eye space; inactive ones are left out
  M44d eye_to_world;                                  ///< row vectors; for shaders that speak of the world
  std::shared_ptr<const NoiseTable> noise = nullptr;  ///< of patterns; nullptr: standard_noise()
};

}  // namespace farop
