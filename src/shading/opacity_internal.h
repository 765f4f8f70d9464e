// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/color.h"

namespace farop {

/// Nothing behind is seen, in any channel.
inline bool hides_all(const Rgb& opacity) {
  return opacity.r >= 1 && opacity.g >= 1 && opacity.b >= 1;
}

/// Nothing of the surface itself is seen.
inline bool hides_nothing(const Rgb& opacity) {
  return opacity.r <= 0 && opacity.g <= 0 && opacity.b <= 0;
}

}  // namespace farop
