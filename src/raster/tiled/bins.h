// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles of a frame, sorted into the tiles that they meet.
//
// A triangle is stored once per tile, in one cache line: sorting touches one line, and tiles are drawn
// without looking elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/tiled/slabs.h"

namespace farop::tiled {

/// TriangleEntry::z[0] of an entry that is no triangle.
/// k_special: a polygon to be drawn one sample at a time, whose number is in `source`.
/// k_spans: pieces of spans (kept_spans.h), `x[1]` of them from `x[0]` on; no sample is nearer than `z[1]`.
constexpr std::int32_t k_special = -1, k_spans = -2;

struct alignas(64) TriangleEntry {
  std::int32_t x[3], y[3], z[3];  ///< corners a, b, c of Triangle
  /// Colours of the corners, 8 bits each, red lowest; in Phong frames their numbers among the kept corners.
  std::uint32_t color[3];
  std::uint32_t source;  ///< number of the kept polygon, where there is one
  std::uint32_t batch;   ///< of the frame, in drawing order
  std::uint16_t portion;
  std::uint16_t transparent;  ///< 1: not opaque; `source` has the opacities of a triangle's corners
};

/// Entries of a tile are chained in blocks.
constexpr std::uint32_t k_block = 15;
struct EntryBlock {
  TriangleEntry entries[k_block];
  alignas(64) EntryBlock* next;
};

/// Blocks are handed out from slabs, which are kept from frame to frame.
class BlockPool {
 public:
  /// Neither entries nor `next` are set.
  EntryBlock* take();
  void take_all_back() { used_ = 0, slab_ = 0, in_slab_ = 0; }
  std::size_t used_bytes() const { return used_ * sizeof(EntryBlock); }

 private:
  std::vector<Slab> slabs_;
  std::size_t used_ = 0;                ///< blocks
  std::size_t slab_ = 0, in_slab_ = 0;  ///< where the next block comes from
};

/// The chain of one tile.
struct Bin {
  EntryBlock* first = nullptr;
  EntryBlock* last = nullptr;
  std::uint32_t in_last = k_block;  ///< entries of `last`
  std::uint32_t size = 0;           ///< of all
  bool has_transparent = false;     ///< set by who adds

  /// Room for an entry at the end; the caller fills it.
  TriangleEntry& add(BlockPool& pool) {
    if (in_last == k_block) grow(pool);
    ++size;
    TriangleEntry* const entry = &last->entries[in_last++];
    __builtin_prefetch(entry + 1, 1);  // thousands of cycles until its turn comes: never in the cache else
    return *entry;
  }

 private:
  void grow(BlockPool& pool);
};

}  // namespace farop::tiled
