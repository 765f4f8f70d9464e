// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of the device space, with the reason for each.
#pragma once

#include <cstdint>

namespace farop {

/// XRES, YRES: with 8 sub-pixel bits a coordinate stays below 2^23, so edge functions are exact in 64 bits
/// even when super-sampled 256 x 256.
constexpr int k_max_resolution = 32767;
/// ZRES: depth and its differences fit a signed 32-bit integer.
constexpr std::int64_t k_max_depth_resolution = std::int64_t{1} << 30;
constexpr std::int64_t k_min_depth_resolution = 2;
/// CRES: a component fits 16 bits (65535 at most).
constexpr int k_max_color_resolution = 65536;
constexpr int k_min_color_resolution = 2;
constexpr int k_max_subpixel_bits = 8;
/// Degree of super-sampling: 16 x 16 = 256 samples a pixel; beyond that an 8-bit mean no longer changes
/// visibly.
constexpr int k_max_samples = 16;
/// Side of a shadow map, texels: 1 GiB while it is drawn.
constexpr int k_max_shadow_size = 8192;
/// Texels of all shadow maps of a frame: 1 GiB, or 4096 maps of the usual size.
constexpr std::int64_t k_max_shadow_texels = std::int64_t{1} << 28;
/// Vertices of one polygon: a billion needs 24 GB already; the count must fit 30 bits of a stored record.
constexpr std::int64_t k_max_polygon_vertices = (std::int64_t{1} << 30) - 1;

}  // namespace farop
