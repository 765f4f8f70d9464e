// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading/shade.h"

#include "shading/reflection.h"

namespace farop {

Shaded shade(const Shader* shader, const Material& material, const V3d& position, const V3d& normal,
             const V3d& texture, const ShadingFrame& frame) {
  if (shader != nullptr) return shader->shade({position, normal, texture, -position.normalized()}, frame);
  return {reflect(material, frame.lights, position, normal, V3d(0, 0, 0)), material.opacity()};
}

}  // namespace farop
