// SPDX-License-Identifier: GPL-3.0-or-later
// What rasterizers do instead of the required fill rule: 18 rules by name, and the usual slips of scan-line
// fillers, each as a function from a polygon to the samples that it would draw.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "conformance/coverage.h"

namespace farop::conformance {

/// The eight consistent rules, then ten that are not (or sample elsewhere).
enum class FillRule : std::uint8_t {
  lb,
  lt,
  rb,
  rt,
  lb2,
  lt2,
  rb2,
  rt2,
  closed,       ///< all boundary samples
  open,         ///< none of them
  closed_span,  ///< ceil(xL) .. floor(xR)
  lb_min,       ///< lb, and the lowest tip of a V
  touch,        ///< floor(xL) .. floor(xR)
  round,        ///< xL .. xR, both rounded to nearest
  round_less,   ///< the same without the last one
  trunc,        ///< floor(xL) .. floor(xR) - 1
  half_centre,  ///< lb at (x + 1/2, y + 1/2)
  outline       ///< Bresenham's edges, filled between the outermost
};
constexpr int k_fill_rules = 18;

/// "lb", "lb'", "closed-span", "lb+min", "round-1" ...
std::string_view rule_name(FillRule rule);
constexpr bool is_consistent(FillRule rule) {
  return rule <= FillRule::rt2;
}

/// 1 at every sample of the window that the rule covers.
Bitmap rule_coverage(std::span<const ScreenVertex> polygon, FillRule rule, const Window& window);

/// A slip that a scan-line filler can make, with the verdict it stands for.
enum class Slip : std::uint8_t {
  last_row_dropped,        ///< edges live for ymin <= y < ymax - 1
  first_row_late,          ///< ymin < y < ymax
  last_row_kept,           ///< ymin <= y <= ymax
  pass_through_twice,      ///< ymin <= y <= ymax, of a pass-through vertex both edges count
  maximum_once,            ///< at a local maximum one edge of two counts
  horizontal_counted,      ///< horizontal edges count as a crossing at their start
  outermost_crossings,     ///< from the first to the last crossing of a row
  convex_hull,             ///< the hull is filled
  closing_edge_missing,    ///< no edge from the last to the first corner
  repeated_vertex_ends,    ///< corners behind a repeated one are not seen
  thin_dropped,            ///< polygons of fewer than 2 samples vanish
  counter_clockwise_lost,  ///< only clockwise polygons are drawn
  clockwise_lost
};
constexpr int k_slips = 13;

struct SlipFacts {
  std::string_view verdict, sentence, hint;
};
const SlipFacts& slip_facts(Slip slip);

/// What a filler with this slip draws, otherwise by rule lb. Where an odd number of crossings is left over,
/// `open_end` says whether the last one fills to the window's right border or nothing.
Bitmap slip_coverage(std::span<const ScreenVertex> polygon, Slip slip, bool open_end, const Window& window);

}  // namespace farop::conformance
