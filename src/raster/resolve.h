// SPDX-License-Identifier: GPL-3.0-or-later
// From samples to the picture: deferred Phong shading, transparency, averaging.
#pragma once

#include "core/framebuffer.h"
#include "raster/raster_counts.h"
#include "raster/sample_buffer.h"
#include "shading/light.h"

namespace farop {

/// Draws the samples of `buffer`, all of whose values are known, into the part of the picture that they make;
/// the window starts and ends at multiples of `degree`. Every sample is finished and rounded to 8 bits, then
/// blocks of degree x degree are averaged and rounded to nearest; depth, where the picture has it, is that of
/// the nearest sample. Samples of Phong frames are lit as `shading` says; counts.reflections grows.
void resolve(SampleBuffer& buffer, int degree, Transparency transparency, const ShadingFrame& shading,
             RasterCounts& counts, Framebuffer& picture);

/// The same of a buffer whose words hold the finished colours of all samples.
void resolve_words(const SampleBuffer& buffer, int degree, Framebuffer& picture);

}  // namespace farop
