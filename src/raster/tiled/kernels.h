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
#include <vector>

#include "raster/tiled/bins.h"
#include "raster/tiled/kept_spans.h"

namespace farop::tiled {

/// Side of the largest tile, and samples from row to row in all of them.
constexpr int k_tile = 64;
/// Samples behind the last row that are read, never written.
constexpr int k_tile_padding = 64;
constexpr int k_far_blocks = k_tile / 8;
/// Bins that can be drawn together.
constexpr int k_max_bins = 8;

/// Numbers of surfaces at samples. Of triangles: their places in drawing order in the tile, from 0. Of pieces
/// of spans: this bit, the portion that has them, and their place there.
constexpr std::uint32_t k_piece_bit = 1u << 31;
constexpr int k_portion_shift = 28;

/// Something transparent at a sample that was not behind anything opaque when it was drawn.
struct PendingFragment {
  std::uint32_t number;
  std::int32_t depth;
  std::uint32_t sample;
};

/// In drawing order.
class PendingFragments {
 public:
  // Defined here, outside of what is compiled for particular processors.
  void add(const PendingFragment& fragment) { all_.push_back(fragment); }
  const std::vector<PendingFragment>& all() const { return all_; }
  void clear() { all_.clear(); }

 private:
  std::vector<PendingFragment> all_;
};

/// A tile and what is drawn into it. Arrays have k_tile * k_tile + k_tile_padding samples.
struct TileTask {
  int x = 0, y = 0;           ///< of its first sample in the frame
  int width = 0, height = 0;  ///< 1..k_tile
  int subpixel_bits = 0;
  std::int32_t empty_depth = 0;
  std::int32_t* depth = nullptr;  ///< 64-byte aligned
  // Of the nearest opaque surfaces; one of them or both.
  std::uint32_t* word = nullptr;            ///< colours, red lowest
  std::uint32_t* number = nullptr;          ///< without it nothing transparent can be drawn
  std::int32_t* far = nullptr;              ///< k_far_blocks^2: no depth in the 8 x 8 block is farther
  const TriangleEntry** entries = nullptr;  ///< with `number`: gets the entry of every triangle's
  const KeptSpans* spans[k_max_bins] = {};  ///< of portions
  PendingFragments* fragments = nullptr;    ///< gets those drawn
  /// Draws the polygon that an entry stands for, into depth and word.
  void (*special)(void* context, const TriangleEntry& entry) = nullptr;
  void* context = nullptr;
};

/// Empties the tile: `empty_depth`, and below every depth outside the frame; word and number everywhere.
void clear_tile(const TileTask& task, std::uint32_t word, std::uint32_t number);
/// Draws the entries of `count` bins, in the order of their batches and within a batch bin after bin.
void draw_bins(const TileTask& task, const Bin* const* bins, int count);
/// `count` words as bytes r g b.
void words_to_rgb(const std::uint32_t* words, int count, std::uint8_t* rgb);

}  // namespace farop::tiled
