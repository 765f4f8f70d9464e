// SPDX-License-Identifier: GPL-3.0-or-later
// The inner loops of the tiled rasterizer, compiled for every vector instruction set and chosen at run time
// (Highway). All sets give the same samples.
//
// Method: 8 or 16 triangles are set up at once. Coverage comes from exact edge crossings, 8 rows at once: the
// first sample at or right of an edge is ceil(n / d) of integers below 2^53, found with a reciprocal, since
// the fraction of n / d is 0 or at least 1/d. Samples are tested in rows of vectors; a block of 8 x 8 samples
// whose farthest depth is nearer than all of the triangle is passed over (hierarchical z: N. Greene, M. Kass,
// G. Miller, "Hierarchical Z-Buffer Visibility", SIGGRAPH 1993). Tiles and masks over small blocks: J.
// Hasselgren, M. Andersson, T. Akenine-Möller, "Masked Software Occlusion Culling", High-Performance Graphics
// 2016.
#pragma once

#include <cstdint>

#include "raster/tiled/bins.h"

namespace farop::tiled {

/// Side of the largest tile, and samples from row to row in all of them.
constexpr int k_tile = 64;
/// Samples behind the last row that are read, never written.
constexpr int k_tile_padding = 64;
constexpr int k_far_blocks = k_tile / 8;
/// Bins that can be drawn together.
constexpr int k_max_bins = 8;

/// A tile and what is drawn into it. Arrays have k_tile * k_tile + k_tile_padding samples.
struct TileTask {
  int x = 0, y = 0;           ///< of its first sample in the frame
  int width = 0, height = 0;  ///< 1..k_tile
  int subpixel_bits = 0;
  std::int32_t empty_depth = 0;
  std::int32_t* depth = nullptr;  ///< 64-byte aligned
  /// Colours, red lowest, of the nearest opaque triangles; or with `numbered` their numbers: their places in
  /// drawing order, from 0.
  std::uint32_t* word = nullptr;
  std::int32_t* far = nullptr;  ///< k_far_blocks^2: no depth in the 8 x 8 block is farther
  bool numbered = false;
  const TriangleEntry** entries = nullptr;  ///< numbered: gets the entry of every number
  /// Draws the polygon that an entry stands for, into depth and word.
  void (*special)(void* context, const TriangleEntry& entry) = nullptr;
  void* context = nullptr;
};

/// Empties the tile: `empty_depth`, and below every depth outside the frame; word everywhere.
void clear_tile(const TileTask& task, std::uint32_t word);
/// Draws the entries of `count` bins, in the order of their batches and within a batch bin after bin.
void draw_bins(const TileTask& task, const Bin* const* bins, int count);
/// `count` words as bytes r g b.
void words_to_rgb(const std::uint32_t* words, int count, std::uint8_t* rgb);

}  // namespace farop::tiled
