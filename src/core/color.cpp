// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/color.h"

#include <algorithm>

namespace farop {

Rgb clamp01(const Rgb& c) {
  const auto limit = [](double v) { return v > 0 ? std::min(v, 1.0) : 0.0; };
  return {limit(c.r), limit(c.g), limit(c.b)};
}

}  // namespace farop
