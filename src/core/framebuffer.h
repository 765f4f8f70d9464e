// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace farop {

/// A picture in memory, row 0 at the bottom (y grows upwards everywhere; writers flip).
struct Framebuffer {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 bytes a pixel, rows without padding, linear
  /// Integer depth as float, parallel to the pixels, ZRES where nothing opaque was drawn; empty when not
  /// asked for.
  std::vector<float> depth;

  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

}  // namespace farop
