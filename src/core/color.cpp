// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/color.h"

#include <algorithm>

namespace farop {

Rgb clamp01(const Rgb& c) {
  return {std::clamp(c.r, 0.0, 1.0), std::clamp(c.g, 0.0, 1.0), std::clamp(c.b, 0.0, 1.0)};
}

}  // namespace farop
