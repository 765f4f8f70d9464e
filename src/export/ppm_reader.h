// SPDX-License-Identifier: GPL-3.0-or-later
// Netpbm -> frame memory: pictures (PPM, P6) and depths (PGM, P5) that users' programs have drawn. In the
// files the top row comes first; samples above the maximum 255 have two bytes, the higher one first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/framebuffer.h"

namespace farop {

/// Reads a binary PPM of any maximum; other maxima than 255 are scaled to 255 and rounded to nearest. Throws
/// Error(ExitStatus::input) with what was found and expected: no such file, another format (P3, PNG ...), a
/// maximum beyond 65535, a size beyond k_max_resolution, too few or too many bytes.
Framebuffer read_ppm(const std::string& path);

/// Depths as a program keeps them: row 0 at the bottom, `maximum` is ZRES - 1.
struct DepthPicture {
  int width = 0, height = 0, maximum = 0;
  std::vector<std::uint16_t> z;
};

/// Reads a binary PGM. Throws as read_ppm() does.
DepthPicture read_depth_pgm(const std::string& path);

}  // namespace farop
