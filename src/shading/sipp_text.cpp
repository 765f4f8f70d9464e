// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "shading/sipp_text_internal.h"

namespace farop {

std::string color_text(const Rgb& color) {
  return fmt::format("{{{} {} {}}}", color.r, color.g, color.b);
}

void approximate_common(double ambient, const Rgb& opacity, Material& material,
                        std::vector<std::string>* lost) {
  material.ka = ambient;
  // Halves and the like stay exact where the channels agree.
  const bool one_opacity = opacity.r == opacity.g && opacity.g == opacity.b;
  const Rgb o = clamp01(opacity);
  material.transmittance = one_opacity ? 1 - o.r : 1 - (o.r + o.g + o.b) / 3;
  if (lost == nullptr) return;
  if (ambient != Material{}.ka)
    lost->push_back(fmt::format("ambient coefficients other than {}", Material{}.ka));
  if (!one_opacity) lost->emplace_back("opacities that differ by channel (their mean is written)");
}

}  // namespace farop
