// SPDX-License-Identifier: GPL-3.0-or-later
// From samples to the picture: deferred Phong shading, transparency, averaging.
#pragma once

#include <cstdint>

#include "core/framebuffer.h"
#include "raster/raster_counts.h"
#include "raster/sample_buffer.h"
#include "shading/light.h"

namespace farop {

/// 0..255 rounded to nearest, halves upwards; what lies outside is limited.
std::uint8_t to_byte(double component);

/// The picture of buffer.width / degree x buffer.height / degree pixels. Every sample is finished and rounded
/// to 8 bits, then blocks of degree x degree are averaged and rounded to nearest; depth is that of the
/// nearest sample. Samples of Phong frames are lit as `shading` says; counts.reflections grows.
Framebuffer resolve(SampleBuffer& buffer, int degree, bool keep_depth, Transparency transparency,
                    const ShadingFrame& shading, RasterCounts& counts);

}  // namespace farop
