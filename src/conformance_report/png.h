// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/framebuffer.h"

namespace farop::conformance_report {

/// The picture as "data:image/png;base64,...", top row first; "" for an empty picture or where libpng fails.
std::string png_data_url(const Framebuffer& picture);

}  // namespace farop::conformance_report
