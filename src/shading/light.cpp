// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading/light.h"

#include <cmath>
#include <numbers>

namespace farop {
namespace {

double cone_fraction(const LightSource& light, const V3d& to_light) {
  const double k = -to_light.dot(light.axis);
  if (k < light.cos_half_angle) return 0;
  if (light.kind == LightKind::spot_sharp) return 1;
  if (k <= 0) return 0;
  const double width = 1 - light.cos_half_angle;
  return width > 0 ? 0.5 + 0.5 * std::cos(std::numbers::pi * (1 - k) / width) : 1;
}

}  // namespace

Illumination illuminate(const LightSource& light, const V3d& point) {
  if (light.kind == LightKind::directional) return {light.position, 1};
  Illumination result{(light.position - point).normalized(), 1};  // Imath leaves a zero vector zero
  if (light.kind != LightKind::point) result.fraction = cone_fraction(light, result.to_light);
  if (light.shadow && result.fraction > 0) result.fraction *= light.shadow->unshadowed(point);
  return result;
}

}  // namespace farop
