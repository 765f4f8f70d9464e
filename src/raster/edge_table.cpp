// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/edge_table.h"

#include <algorithm>
#include <tuple>

#include "raster/wide_integer.h"

namespace farop {
namespace {

constexpr std::uint32_t k_no_edge = 0xFFFFFFFFu;

auto key(const ScreenVertex& v) {
  return std::tie(v.y, v.x, v.z, v.r, v.g, v.b);
}

}  // namespace

void EdgeTable::load(std::span<const ScreenVertex> corners) {
  corners_ = corners;
  edges_.clear();
  active_.clear();
  spans_.clear();
  first_row_ = window_.end_y, end_row_ = 0;
  const auto count = static_cast<std::uint32_t>(corners.size());
  for (std::uint32_t i = 0; i < count; ++i) add_edge(i, i + 1 < count ? i + 1 : 0);

  first_row_ = std::min(first_row_, end_row_);
  buckets_.assign(static_cast<std::size_t>(end_row_ - first_row_), k_no_edge);
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    std::uint32_t& bucket = buckets_[static_cast<std::size_t>(edges_[e].start_row - first_row_)];
    edges_[e].next = bucket;
    bucket = e;
  }
  row_ = first_row_ - 1;
}

// Enters the edge between two corners unless it meets no row of the window (horizontal edges never do).
void EdgeTable::add_edge(std::uint32_t a, std::uint32_t b) {
  if (corners_[a].y > corners_[b].y) std::swap(a, b);
  const std::int64_t x1 = corners_[a].x, y1 = corners_[a].y;
  const std::int64_t x2 = corners_[b].x, y2 = corners_[b].y;
  const auto row_at_or_above = [&](std::int64_t y) { return -((-y) >> subpixel_bits_); };
  const std::int64_t start = std::max<std::int64_t>(row_at_or_above(y1), window_.y);
  const std::int64_t end = std::min<std::int64_t>(row_at_or_above(y2), window_.end_y);
  if (start >= end) return;

  const std::int64_t dx = x2 - x1, dy = y2 - y1;
  Edge edge;
  edge.bottom = a, edge.top = b;
  edge.start_row = static_cast<std::int32_t>(start), edge.end_row = static_cast<std::int32_t>(end);
  edge.denominator = dy << subpixel_bits_;
  const Int128 crossing = Int128{x1} * dy + Int128{(start << subpixel_bits_) - y1} * dx;  // times denominator
  const Int128 first = -floor_div<Int128>(-crossing, edge.denominator);
  edge.first = static_cast<std::int64_t>(first);
  edge.excess = static_cast<std::int64_t>(first * edge.denominator - crossing);
  edge.step = floor_div(dx, dy);
  edge.excess_step = (dx - edge.step * dy) << subpixel_bits_;
  edges_.push_back(edge);
  first_row_ = std::min(first_row_, edge.start_row);
  end_row_ = std::max(end_row_, edge.end_row);
}

bool EdgeTable::next_row() {
  spans_.clear();
  if (row_ + 1 >= end_row_) return false;
  ++row_;
  std::erase_if(active_, [&](std::uint32_t e) { return edges_[e].end_row <= row_; });
  for (const std::uint32_t e : active_) {
    Edge& edge = edges_[e];
    edge.first += edge.step;
    edge.excess -= edge.excess_step;
    if (edge.excess < 0) edge.excess += edge.denominator, ++edge.first;
  }
  for (std::uint32_t e = buckets_[static_cast<std::size_t>(row_ - first_row_)]; e != k_no_edge;
       e = edges_[e].next) {
    active_.push_back(e);
  }
  // Edges of a simple polygon keep their order, so this sorts on rows with new edges only.
  const auto in_order = [&](std::uint32_t a, std::uint32_t b) { return left_of(edges_[a], edges_[b]); };
  if (!std::is_sorted(active_.begin(), active_.end(), in_order))
    std::sort(active_.begin(), active_.end(), in_order);
  collect_spans();
  return true;
}

// Order of the crossings on the current row. Equal crossings are told apart by their corners, so that the
// pairs do not depend on how the corners are numbered; by their numbers where corners are the same here and
// differ in what is not known here (opacities, normals), so that all windows have the same pairs.
bool EdgeTable::left_of(const Edge& a, const Edge& b) const {
  if (a.first != b.first) return a.first < b.first;
  const Int128 excess_a = Int128{a.excess} * b.denominator, excess_b = Int128{b.excess} * a.denominator;
  if (excess_a != excess_b) return excess_a > excess_b;
  return std::tuple_cat(key(corners_[a.bottom]), key(corners_[a.top]), std::tie(a.bottom, a.top)) <
         std::tuple_cat(key(corners_[b.bottom]), key(corners_[b.top]), std::tie(b.bottom, b.top));
}

EdgePoint EdgeTable::crossing(const Edge& edge) const {
  const std::int64_t y1 = corners_[edge.bottom].y, y2 = corners_[edge.top].y;
  const std::int64_t y = std::int64_t{row_} << subpixel_bits_;
  return {edge.bottom, edge.top, static_cast<double>(y - y1) / static_cast<double>(y2 - y1)};
}

void EdgeTable::collect_spans() {
  for (std::size_t k = 0; k + 1 < active_.size(); k += 2) {
    const Edge& left = edges_[active_[k]];
    const Edge& right = edges_[active_[k + 1]];
    const std::int64_t first = std::max<std::int64_t>(left.first, window_.x);
    const std::int64_t end = std::min<std::int64_t>(right.first, window_.end_x);
    if (first >= end) continue;
    // Distances are sums of terms that are exact up to rounding and never negative: a span much narrower than
    // a pixel keeps its relative precision, however steep the attributes run in it.
    const double left_rest = static_cast<double>(left.excess) / static_cast<double>(left.denominator);
    const double right_rest =
        static_cast<double>(right.denominator - right.excess) / static_cast<double>(right.denominator);
    Span span;
    span.first = static_cast<int>(first), span.end = static_cast<int>(end);
    span.left_column = left.first, span.left_rest = left_rest;
    span.width = (static_cast<double>(right.first - 1 - left.first) + left_rest) + right_rest;
    span.left = crossing(left), span.right = crossing(right);
    spans_.push_back(span);
  }
}

}  // namespace farop
