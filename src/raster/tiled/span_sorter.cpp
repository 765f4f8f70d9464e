// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/tiled/span_sorter.h"

#include <algorithm>
#include <stdexcept>

namespace farop::tiled {
namespace {

V3d color_of(const ScreenVertex& v) {
  return {static_cast<double>(v.r), static_cast<double>(v.g), static_cast<double>(v.b)};
}

bool same(const Ramp<V3d>& a, const Ramp<V3d>& b) {
  return a.start == b.start && a.slope == b.slope;
}

}  // namespace

void SpanSorter::start(const TileGrid& grid) {
  grid_ = &grid;
  pieces_.resize(static_cast<std::size_t>(grid.columns));
  for (std::vector<SpanPiece>& pieces : pieces_) pieces.clear();
  columns_.clear();
  edge_table_ = EdgeTable(grid.width, grid.height, grid.subpixel_bits);
}

int SpanSorter::sort(std::span<const ScreenVertex> corners, std::span<const V3d> opacities, int first_row,
                     std::size_t byte_limit, KeptSpans& kept, const AddPieces& add) {
  edge_table_.set_first_row(first_row);
  edge_table_.load(corners);
  int tile_row = -1;
  while (edge_table_.next_row()) {
    const int row = edge_table_.row();
    const int of = grid_->tile_of[static_cast<std::size_t>(row)];
    if (of != tile_row) {
      end_tile_row(tile_row, kept, add);
      if (tile_row >= 0 && kept.bytes() > byte_limit) return row;
      tile_row = of;
    }
    for (const Span& span : edge_table_.spans()) {
      const auto number = static_cast<std::uint32_t>(kept.spans.size());
      keep(span, corners, opacities, kept);
      cut(span, number, row - tile_row * grid_->side);
    }
  }
  end_tile_row(tile_row, kept, add);
  return 0;
}

void SpanSorter::keep(const Span& span, std::span<const ScreenVertex> corners, std::span<const V3d> opacities,
                      KeptSpans& kept) const {
  const auto along = [&](const EdgePoint& point, const auto& value) {
    return mix(point, value(point.bottom), value(point.top));
  };
  const auto depth = [&](std::uint32_t i) { return static_cast<double>(corners[i].z); };
  const auto color = [&](std::uint32_t i) { return color_of(corners[i]); };
  KeptSpan s{static_cast<double>(span.left_column), span.left_rest,
             depth_ramp(along(span.left, depth), along(span.right, depth), span.width),
             Ramp<V3d>(along(span.left, color), along(span.right, color), span.width), 0};
  if (!opacities.empty()) {
    const auto opacity = [&](std::uint32_t i) { return opacities[i]; };
    const Ramp<V3d> ramp(along(span.left, opacity), along(span.right, opacity), span.width);
    // Mostly all of a polygon are the same.
    if (kept.opacities.empty() || !same(kept.opacities.back(), ramp)) kept.opacities.push_back(ramp);
    s.opacity = static_cast<std::uint32_t>(kept.opacities.size() - 1);
  }
  kept.spans.push_back(s);
}

// Into the pieces that tiles have, `row` rows above their first.
void SpanSorter::cut(const Span& span, std::uint32_t number, int row) {
  const auto column_of = [&](int x) { return grid_->tile_of[static_cast<std::size_t>(x)]; };
  const int side = grid_->side, last = column_of(span.end - 1);
  for (int column = column_of(span.first); column <= last; ++column) {
    std::vector<SpanPiece>& pieces = pieces_[static_cast<std::size_t>(column)];
    if (pieces.empty()) columns_.push_back(column);
    const int x = column * side;
    pieces.push_back({number, static_cast<std::uint8_t>(row),
                      static_cast<std::uint8_t>(std::max(span.first - x, 0)),
                      static_cast<std::uint8_t>(std::min(span.end - x, side))});
  }
}

// Nothing to do before the first.
void SpanSorter::end_tile_row(int tile_row, KeptSpans& kept, const AddPieces& add) {
  for (const int column : columns_) {
    std::vector<SpanPiece>& pieces = pieces_[static_cast<std::size_t>(column)];
    const std::size_t first = kept.pieces.size();
    if (first + pieces.size() > k_most_pieces) throw std::length_error("too many spans");
    for (const SpanPiece& piece : pieces) kept.pieces.push_back(piece);
    add(tile_row * grid_->columns + column, static_cast<std::uint32_t>(first),
        static_cast<std::uint32_t>(pieces.size()));
    pieces.clear();
  }
  columns_.clear();
}

std::size_t SpanSorter::most_bytes(std::span<const ScreenVertex> corners) const {
  const auto row = [&](const ScreenVertex& v) {
    const std::int64_t at_or_above = -(-std::int64_t{v.y} >> grid_->subpixel_bits);
    return std::clamp<std::int64_t>(at_or_above, 0, grid_->height);
  };
  std::int64_t crossings = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ScreenVertex& next = corners[i + 1 < corners.size() ? i + 1 : 0];
    crossings += std::abs(row(corners[i]) - row(next));
  }
  const auto spans = static_cast<std::size_t>(crossings / 2);
  // The spans of a row are cut once a tile at most.
  const auto pieces = spans + std::min(spans, static_cast<std::size_t>(grid_->height)) *
                                  static_cast<std::size_t>(grid_->columns);
  return spans * (sizeof(KeptSpan) + sizeof(Ramp<V3d>)) + pieces * sizeof(SpanPiece);
}

}  // namespace farop::tiled
