// SPDX-License-Identifier: GPL-3.0-or-later
// Scan conversion of one polygon: edge table, active edge table, spans.
//
// Coverage: fill rule `lb` with parity, exactly. Sample (i, j) is covered iff the number of non-horizontal
// edges e with ymin(e) <= j < ymax(e) and x_e(j) <= i is odd: left and bottom edges belong to the polygon,
// right and top ones do not. Concave polygons, edges walked twice, zero-length edges and polygons that cross
// themselves need no special case. Sample (i, j) lies at (i << N, j << N) in vertex units, N = subpixel_bits.
// Cost:     O(n + rows) to load, O(k log k) a row with k active edges, O(k) where their order stays.
// Numbers:  legal coordinates reach 32767 * 16 << 8 < 2^27; every int32 is safe. Stepping stays below 2^41;
//           only the first crossing of an edge and comparisons of equal columns take products of more than 64
//           bits.
// Source:   J. D. Foley et al., "Computer Graphics: Principles and Practice", 2nd ed., 1990, section 3.6.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/screen_polygon.h"

namespace farop {

/// A point on an edge: corner `bottom` (0) .. corner `top` (1) of the polygon, 0 <= along < 1.
struct EdgePoint {
  std::uint32_t bottom = 0, top = 0;
  double along = 0;
};

/// Covered samples of one row between two crossings x_left < x_right.
/// Column i lies at distance(i) / width of the way from `left` to `right`; never negative, below 1 but for
/// the last bit. Of a window of the frame only first and end differ from the whole frame's.
struct Span {
  int first = 0, end = 0;        ///< columns first .. end - 1, inside the window, at least one
  std::int64_t left_column = 0;  ///< first sample at or to the right of x_left, wherever the window is
  double left_rest = 0;          ///< left_column - x_left
  double width = 0;              ///< x_right - x_left, columns, > 0
  EdgePoint left, right;

  double distance(int column) const { return static_cast<double>(column - left_column) + left_rest; }
};

/// Columns x .. end_x - 1 and rows y .. end_y - 1 of a frame, none negative.
struct Window {
  int x = 0, y = 0, end_x = 0, end_y = 0;
};

class EdgeTable {
 public:
  /// Spans are cut to columns 0 .. width - 1 and rows 0 .. height - 1.
  EdgeTable(int width, int height, int subpixel_bits) : EdgeTable({0, 0, width, height}, subpixel_bits) {}
  /// Spans are cut to the window.
  EdgeTable(const Window& window, int subpixel_bits) : window_(window), subpixel_bits_(subpixel_bits) {}

  /// Rows below are left out of the polygons loaded from now on.
  void set_first_row(int row) { window_.y = row; }
  /// Starts a polygon: any number of corners, any coordinates. `corners` must live until the last next_row().
  void load(std::span<const ScreenVertex> corners);
  /// Goes to the next row that an edge crosses, upwards; false behind the last one.
  bool next_row();
  int row() const { return row_; }
  /// Of row(), from left to right, not overlapping. Which edges bound them depends on the corners alone, not
  /// on which one comes first or which way round they run.
  std::span<const Span> spans() const { return spans_; }

 private:
  /// Crosses the current row at x = first - excess / denominator, so `first` is the first covered column to
  /// the right.
  struct Edge {
    std::int64_t first = 0;
    std::int64_t excess = 0;       ///< edge function at (first, row): 0 <= excess < denominator
    std::int64_t denominator = 0;  ///< height of the edge << N
    std::int64_t step = 0;         ///< from row to row x grows by step + excess_step / denominator
    std::int64_t excess_step = 0;
    std::int32_t start_row = 0, end_row = 0;  ///< alive on start_row .. end_row - 1
    std::uint32_t bottom = 0, top = 0;        ///< corners
    std::uint32_t next = 0;                   ///< in the bucket of start_row
  };

  void add_edge(std::uint32_t a, std::uint32_t b);
  void collect_spans();
  bool left_of(const Edge& a, const Edge& b) const;
  EdgePoint crossing(const Edge& edge) const;

  Window window_;
  int subpixel_bits_;
  std::span<const ScreenVertex> corners_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> buckets_;  ///< per row from first_row_: first edge that starts there
  std::vector<std::uint32_t> active_;   ///< edges that cross row_, from left to right
  std::vector<Span> spans_;
  int first_row_ = 0, end_row_ = 0;  ///< of the polygon, inside the window
  int row_ = 0;
};

}  // namespace farop
