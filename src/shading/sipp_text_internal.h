// SPDX-License-Identifier: GPL-3.0-or-later
// Shader parameters as words.
#pragma once

#include <string>
#include <vector>

#include "core/color.h"
#include "shading/material.h"

namespace farop {

/// "{r g b}", the shortest digits that read back as the same numbers.
std::string color_text(const Rgb& color);

/// Gives `material` the ambient coefficient and opacity of a shader; adds to `lost` (if given) what NFF
/// cannot say of them: an ambient other than 0.30, an opacity that is not one for all channels.
void approximate_common(double ambient, const Rgb& opacity, Material& material,
                        std::vector<std::string>* lost);

}  // namespace farop
