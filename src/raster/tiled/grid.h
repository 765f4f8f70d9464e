// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/screen_polygon.h"
#include "raster/edge_table.h"

namespace farop::tiled {

/// The tiles of a frame, row by row from the bottom.
struct TileGrid {
  TileGrid() = default;
  /// Sides of `side` samples, but those at the right and the top.
  TileGrid(const ScreenFrame& frame, int tile_side)
      : width(frame.resolution.x),
        height(frame.resolution.y),
        subpixel_bits(frame.subpixel_bits),
        side(tile_side),
        columns((width + side - 1) / side),
        rows((height + side - 1) / side),
        tile_of(static_cast<std::size_t>(std::max(width, height))) {
    for (std::size_t i = 0; i < tile_of.size(); ++i) tile_of[i] = static_cast<std::int32_t>(i) / side;
  }

  int count() const { return columns * rows; }
  Window window(int tile) const {
    const int x = tile % columns * side, y = tile / columns * side;
    return {x, y, std::min(x + side, width), std::min(y + side, height)};
  }

  int width = 0, height = 0, subpixel_bits = 0;  ///< of the frame
  int side = 1;
  int columns = 0, rows = 0;
  std::vector<std::int32_t> tile_of;  ///< column (row) of samples -> of tiles; spares divisions
};

}  // namespace farop::tiled
