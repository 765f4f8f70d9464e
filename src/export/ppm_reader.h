// SPDX-License-Identifier: GPL-3.0-or-later
// PPM (P6) -> frame memory: pictures that users' programs have drawn.
#pragma once

#include <string>

#include "core/framebuffer.h"

namespace farop {

/// Reads a binary PPM with 8 bits a component (maximum 255), whose first row is the top one, as the format
/// says. Throws Error(ExitStatus::input) with what was found and expected: no such file, another format (P3,
/// PNG ...), another maximum, a size beyond k_max_resolution, too few or too many bytes.
Framebuffer read_ppm(const std::string& path);

}  // namespace farop
