// SPDX-License-Identifier: GPL-3.0-or-later
// Picture files of any format that OpenImageIO reads.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace farop {

/// A picture as stored, without any conversion of colours. Not for drawing into: that is Framebuffer.
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< names: R, G, B; Y; Z ...
  /// Row 0 is the top row, as in the file; channels of a pixel side by side, no padding. Integer formats are
  /// scaled to 0..1, floating-point ones hold their own values.
  std::vector<float> values;

  float value(int x, int row, int channel) const {
    const std::size_t pixel =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    return values[pixel * channels.size() + static_cast<std::size_t>(channel)];
  }
};

/// Reads the first picture of a file. Throws Error(ExitStatus::input) with the reason when that is not
/// possible, or when it is larger than k_max_resolution either way.
Image read_image(const std::string& path);

}  // namespace farop
