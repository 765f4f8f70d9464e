// SPDX-License-Identifier: GPL-3.0-or-later
// Between image_*.cpp only: everybody else stays free of OpenImageIO's headers.
#pragma once

#include <OpenImageIO/imagebuf.h>

#include <string>

namespace farop {

/// The first picture of a file, in the type it is stored in. Throws as read_image().
OIIO::ImageBuf load_image_buffer(const std::string& path);

/// What OpenImageIO says of a failure as part of one line; `otherwise` where it says nothing.
std::string one_line(const std::string& message, const std::string& otherwise);

}  // namespace farop
