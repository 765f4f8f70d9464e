// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles of a frame, sorted into the tiles that they meet.
//
// Layout: a tile's list is a chain of blocks of 16 triangles, corners in structure of arrays, so that setting
//         up 8 or 16 of them at once loads whole vectors and gathers nothing. A triangle is stored once per
//         tile: tiles are drawn without looking elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "raster/triangle_planes.h"

namespace farop::tiled {

constexpr std::uint32_t k_block = 16;
/// TriangleBlock::z[0] of an entry that is no triangle: a polygon to be drawn one sample at a time, whose
/// number is in `source`.
constexpr std::int32_t k_special = -1;

struct alignas(64) TriangleBlock {
  std::int32_t x[3][k_block], y[3][k_block], z[3][k_block];  ///< corners a, b, c of Triangle
  /// Colours of the corners, 8 bits each, red lowest; in Phong frames their numbers among the kept corners.
  std::uint32_t color[3][k_block];
  std::uint32_t source[k_block];  ///< number of the kept polygon, where there is one
  TriangleBlock* next;
};

/// What a triangle has beside its place.
struct TrianglePayload {
  std::uint32_t color[3] = {0, 0, 0};
  std::uint32_t source = 0;
};

/// Blocks are handed out from slabs, which are kept from frame to frame.
class BlockPool {
 public:
  TriangleBlock* take();
  void take_all_back() { used_ = 0; }
  std::size_t used_bytes() const { return used_ * sizeof(TriangleBlock); }
  /// Gives memory beyond `bytes` back to the system.
  void shrink(std::size_t bytes);

 private:
  static constexpr std::size_t k_slab = 64;  ///< blocks

  std::vector<std::unique_ptr<TriangleBlock[]>> slabs_;
  std::size_t used_ = 0;
};

/// The chain of one tile.
struct Bin {
  TriangleBlock* first = nullptr;
  TriangleBlock* last = nullptr;
  std::uint32_t in_last = k_block;  ///< entries of `last`

  void add(BlockPool& pool, const Triangle& t, const TrianglePayload& payload) {
    if (in_last == k_block) grow(pool);
    TriangleBlock& b = *last;
    const std::uint32_t i = in_last++;
    b.x[0][i] = t.a.x, b.x[1][i] = t.b.x, b.x[2][i] = t.c.x;
    b.y[0][i] = t.a.y, b.y[1][i] = t.b.y, b.y[2][i] = t.c.y;
    b.z[0][i] = t.a.z, b.z[1][i] = t.b.z, b.z[2][i] = t.c.z;
    b.color[0][i] = payload.color[0], b.color[1][i] = payload.color[1], b.color[2][i] = payload.color[2];
    b.source[i] = payload.source;
  }
  void add_special(BlockPool& pool, std::uint32_t polygon) {
    if (in_last == k_block) grow(pool);
    last->z[0][in_last] = k_special;
    last->source[in_last++] = polygon;
  }

 private:
  void grow(BlockPool& pool);
};

}  // namespace farop::tiled
