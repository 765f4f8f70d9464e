// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading/reflection.h"

#include <algorithm>

#include "shading/power.h"

namespace farop {

Rgb Material::opacity() const {
  const double o = 1 - std::clamp(transmittance, 0.0, 1.0);
  return {o, o, o};
}

Rgb reflect(const Material& material, std::span<const LightSource> lights, const V3d& point,
            const V3d& normal, const V3d& eye) {
  Rgb sum = material.color * material.ka;
  const V3d to_eye = (eye - point).normalized();  // Imath leaves a zero vector zero
  for (const LightSource& light : lights) {
    const auto [to_light, fraction] = illuminate(light, point);
    const double n_dot_l = normal.dot(to_light);
    if (!(n_dot_l > 0) || !(fraction > 0)) continue;
    const Rgb arriving = light.color * fraction;
    sum += arriving * material.color * (material.kd * n_dot_l);
    if (material.ks != 0) {
      const V3d mirrored = 2 * n_dot_l * normal - to_light;
      const double r_dot_v = std::max(0.0, mirrored.dot(to_eye));
      sum += arriving * (material.ks * highlight_power(r_dot_v, material.shine));
    }
  }
  return clamp01(sum);
}

}  // namespace farop
