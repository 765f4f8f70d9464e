// SPDX-License-Identifier: GPL-3.0-or-later
// Whole-frame mistakes: what makes a wrong picture exact when it is undone.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "conformance/drawing.h"
#include "core/framebuffer.h"

namespace farop::conformance {

struct Transform {
  std::string verdict, detail, message, hint;  ///< verdict empty: nothing to undo
  bool flip_x = false, flip_y = false, transpose = false;
  int shift_x = 0, shift_y = 0;
  std::array<int, 3> channels = {0, 1, 2};  ///< of a pixel that was drawn on: where its r, g, b went

  /// The picture as it would be without the mistake.
  Framebuffer undo(const Framebuffer& picture, const Color& background) const;
};

/// All that are tried, simplest first.
std::vector<Transform> whole_frame_transforms();

}  // namespace farop::conformance
