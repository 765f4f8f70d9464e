// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shading/shader.h"

namespace farop {

/// Colour and opacity of a point of a surface: by its shader, or without one (nullptr) by the reflection
/// model of its material. Eye space, the eye at the origin; `normal` is a unit vector turned to the lit side.
Shaded shade(const Shader* shader, const Material& material, const V3d& position, const V3d& normal,
             const V3d& texture, const ShadingFrame& frame);

}  // namespace farop
