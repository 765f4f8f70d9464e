// SPDX-License-Identifier: GPL-3.0-or-later
// shells: a sea shell, spheres along a spiral that grow with it.
#include <cmath>
#include <cstdint>
#include <numbers>

#include "spd/scenes.h"

namespace farop {

void print_shells(NffPrinter& printer, const SceneForm& form) {
  printer.background(k_sky);
  printer.view({.from = {-6, -60, 35}, .at = {0, 8, -15}, .up = {0, 0, 1}, .angle = 45, .hither = 0.5});
  printer.light({-100, -100, 100});
  printer.fill(material({1, 0.8, 0.4}, 0.8, 0.2, 10, 0, 1));

  const std::int64_t steps = std::int64_t{180} << form.size;
  for (std::int64_t i = -2 * steps / 3; i <= steps / 3; ++i) {
    const double angle = 18 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(steps);
    const double radius = std::exp(0.15 * angle);
    printer.sphere({V3d(radius * std::sin(angle), radius * std::cos(angle), -2 * radius), radius});
  }
}

}  // namespace farop
