// SPDX-License-Identifier: GPL-3.0-or-later
// Spans of polygons that are interpolated by scan lines, computed once a polygon and cut at the tiles'
// borders.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math.h"
#include "raster/ramp.h"
#include "raster/tiled/slabs.h"

namespace farop::tiled {

/// A span of one row and what the polygon has along it.
struct KeptSpan {
  double distance(int column) const { return (column - left_column) + left_rest; }

  double left_column, left_rest;  ///< see Span; whole columns are exact
  Ramp<double> depth;             ///< to be truncated
  Ramp<V3d> color;                ///< 0..255
  std::uint32_t opacity;          ///< in KeptSpans::opacities, where the polygon is transparent
};

/// What a tile has of a span; rows and columns from the tile's first.
struct SpanPiece {
  std::uint32_t span;
  std::uint8_t row, first, end;  ///< columns first .. end - 1
};

struct KeptSpans {
  SlabArray<KeptSpan> spans;
  SlabArray<SpanPiece> pieces;  ///< those of a polygon in a tile side by side, rows upwards
  SlabArray<Ramp<V3d>> opacities;

  std::size_t bytes() const { return spans.bytes() + pieces.bytes() + opacities.bytes(); }
  void clear() { spans.clear(), pieces.clear(), opacities.clear(); }
};

/// The most pieces of one KeptSpans: pieces get numbers (see kernels.h).
constexpr std::size_t k_most_pieces = (std::size_t{1} << 28) - 2;

}  // namespace farop::tiled
