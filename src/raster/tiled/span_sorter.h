// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/screen_polygon.h"
#include "raster/edge_table.h"
#include "raster/tiled/grid.h"
#include "raster/tiled/kept_spans.h"

namespace farop::tiled {

/// Sorts the spans of polygons into tiles. A polygon takes time for its corners, the rows that its edges
/// cross and the tiles that its spans meet, however many of each there are beside the others.
class SpanSorter {
 public:
  /// Pieces of a polygon, KeptSpans::pieces `first` .. `first` + `count` - 1, that lie in a tile.
  using AddPieces = std::function<void(int tile, std::uint32_t first, std::uint32_t count)>;

  void start(const TileGrid& grid);

  /// Adds the spans of a polygon to `kept` from `first_row` of the frame on, a row of tiles after another;
  /// stops in between when more than `byte_limit` bytes are kept. Returns the row to go on with, 0 behind the
  /// last one. `corners`: colours 0..255. `opacities`: of the corners; empty where the polygon is opaque.
  int sort(std::span<const ScreenVertex> corners, std::span<const V3d> opacities, int first_row,
           std::size_t byte_limit, KeptSpans& kept, const AddPieces& add);

  /// Bytes that the spans of a polygon take at most.
  std::size_t most_bytes(std::span<const ScreenVertex> corners) const;

 private:
  void keep(const Span& span, std::span<const ScreenVertex> corners, std::span<const V3d> opacities,
            KeptSpans& kept) const;
  void cut(const Span& span, std::uint32_t number, int row);
  void end_tile_row(int tile_row, KeptSpans& kept, const AddPieces& add);

  const TileGrid* grid_ = nullptr;
  EdgeTable edge_table_{0, 0, 0};
  std::vector<std::vector<SpanPiece>> pieces_;  ///< of the row of tiles, by column of tiles
  std::vector<int> columns_;                    ///< that have pieces
};

}  // namespace farop::tiled
