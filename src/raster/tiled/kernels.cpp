// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors whose length is not known before the program runs cannot be members.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/tiled/kernels.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first, so that highway.h is read once per target.
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "raster/tiled/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace farop::tiled::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Lanes of 64 bits set the pace, 32-bit vectors have as many: blocks are 8 wide, more would not help.
using Doubles = hn::CappedTag<double, 8>;
using Longs = hn::RebindToSigned<Doubles>;
using UnsignedLongs = hn::RebindToUnsigned<Doubles>;
using Ints = hn::Rebind<std::int32_t, Doubles>;
using Words = hn::Rebind<std::uint32_t, Doubles>;
constexpr Doubles df;
constexpr Longs dl;
constexpr UnsignedLongs dul;
constexpr Ints di;
constexpr Words dw;
using DoubleVector = hn::Vec<Doubles>;
using LongVector = hn::Vec<Longs>;
using IntVector = hn::Vec<Ints>;
using WordVector = hn::Vec<Words>;

constexpr int k_lanes = static_cast<int>(hn::MaxLanes(Doubles()));

/// Larger than every column.
constexpr double k_beyond = 1e9;
/// See triangle_planes.cpp.
constexpr double k_to_integer = 0x1.8p52;
/// Crossings of columns below 2^16 err by less than 2^-36 and are whole or at least 2^-31 beyond.
constexpr double k_crossing_bias = 0x1p-34;

/// The constants of 16 triangles, one array a constant.
struct alignas(64) SetUp {
  // An edge crosses row j of the tile at column (start + j * slope) * reciprocal.
  double left_start[k_block], left_slope[k_block], left_reciprocal[k_block];
  double right_start[k_block], right_slope[k_block], right_reciprocal[k_block];
  double middle_start[k_block], middle_slope[k_block], middle_reciprocal[k_block];
  double middle_left[k_block];   ///< +beyond where the middle edge bounds the left side, else -beyond
  double middle_right[k_block];  ///< -beyond where it bounds the right side, else +beyond
  std::int64_t depth[k_block], depth_x[k_block], depth_y[k_block];  ///< depth: at the pixel of corner a
  std::uint32_t color[3][k_block], color_x[3][k_block], color_y[3][k_block];  ///< color: at the tile's corner
  std::int32_t pixel_x[k_block], pixel_y[k_block];  ///< of corner a, counted from the tile's corner
  std::int32_t first_row[k_block], end_row[k_block], first_column[k_block], end_column[k_block];
  std::int32_t nearest[k_block];
};

HWY_INLINE LongVector nearest_integer(DoubleVector v) {
  const DoubleVector shift = hn::Set(df, k_to_integer);
  return hn::Sub(hn::BitCast(dl, hn::Add(v, shift)), hn::BitCast(dl, shift));
}

HWY_INLINE WordVector low_words(LongVector v) {
  return hn::TruncateTo(dw, hn::BitCast(dul, v));
}

struct EdgeConstants {
  DoubleVector start, slope, height, reciprocal;
};

HWY_INLINE EdgeConstants edge(DoubleVector x1, DoubleVector y1, DoubleVector x2, DoubleVector y2,
                              DoubleVector tile_x, DoubleVector tile_row, DoubleVector unit) {
  const DoubleVector dx = hn::Sub(x2, x1), dy = hn::Sub(y2, y1);
  const DoubleVector height = hn::Mul(dy, unit);
  // All of these are integers below 2^53.
  const DoubleVector start =
      hn::Sub(hn::Add(hn::Mul(x1, dy), hn::Mul(hn::Sub(tile_row, y1), dx)), hn::Mul(tile_x, height));
  return {start, hn::Mul(dx, unit), height, hn::Div(hn::Set(df, 1.0), height)};
}

/// Sets up entries `lane` .. `lane` + k_lanes - 1 of a block.
HWY_INLINE void set_up_lanes(const TileTask& task, const TriangleBlock& block, bool numbered, int lane,
                             SetUp& out) {
  const int bits = task.subpixel_bits;
  const auto ints = [lane](const std::int32_t* p) { return hn::Load(di, p + lane); };
  const IntVector ax = ints(block.x[0]), bx = ints(block.x[1]), cx = ints(block.x[2]);
  const IntVector ay = ints(block.y[0]), by = ints(block.y[1]), cy = ints(block.y[2]);
  const IntVector az = ints(block.z[0]), bz = ints(block.z[1]), cz = ints(block.z[2]);
  const auto wide = [](IntVector v) { return hn::PromoteTo(df, v); };

  // What the triangle covers at most. Corner a is the lowest.
  const IntVector round_up = hn::Set(di, (1 << bits) - 1);
  const auto at_or_after = [&](IntVector v) { return hn::ShiftRightSame(hn::Add(v, round_up), bits); };
  const IntVector zero = hn::Zero(di);
  const IntVector tile_x = hn::Set(di, task.x), tile_y = hn::Set(di, task.y);
  const IntVector low_x = hn::Min(ax, hn::Min(bx, cx)), high_x = hn::Max(ax, hn::Max(bx, cx));
  hn::Store(hn::Max(hn::Sub(at_or_after(ay), tile_y), zero), di, out.first_row + lane);
  hn::Store(hn::Min(hn::Sub(at_or_after(hn::Max(by, cy)), tile_y), hn::Set(di, task.height)), di,
            out.end_row + lane);
  hn::Store(hn::Max(hn::Sub(at_or_after(low_x), tile_x), zero), di, out.first_column + lane);
  hn::Store(hn::Min(hn::Sub(at_or_after(high_x), tile_x), hn::Set(di, task.width)), di,
            out.end_column + lane);
  hn::Store(hn::Min(az, hn::Min(bz, cz)), di, out.nearest + lane);

  // Edges: a-c on the left, a-b on the right, b-c above them.
  const DoubleVector unit = hn::Set(df, static_cast<double>(1 << bits));
  const DoubleVector column = hn::Set(df, static_cast<double>(task.x));
  const DoubleVector row = hn::Set(df, static_cast<double>(task.y << bits));
  const DoubleVector wide_ax = wide(ax), wide_bx = wide(bx), wide_cx = wide(cx);
  const DoubleVector wide_ay = wide(ay), wide_by = wide(by), wide_cy = wide(cy);
  const DoubleVector none = hn::Zero(df), beyond = hn::Set(df, k_beyond), before = hn::Set(df, -k_beyond);
  const EdgeConstants left = edge(wide_ax, wide_ay, wide_cx, wide_cy, column, row, unit);
  hn::Store(left.start, df, out.left_start + lane);
  hn::Store(left.slope, df, out.left_slope + lane);
  hn::Store(left.reciprocal, df, out.left_reciprocal + lane);
  const EdgeConstants right = edge(wide_ax, wide_ay, wide_bx, wide_by, column, row, unit);
  const auto level = hn::Eq(right.height, none);  // bounds nothing then
  hn::Store(hn::IfThenElse(level, beyond, right.start), df, out.right_start + lane);
  hn::Store(hn::IfThenElse(level, none, right.slope), df, out.right_slope + lane);
  hn::Store(hn::IfThenElse(level, hn::Set(df, 1.0), right.reciprocal), df, out.right_reciprocal + lane);
  const EdgeConstants middle = edge(wide_bx, wide_by, wide_cx, wide_cy, column, row, unit);
  hn::Store(middle.start, df, out.middle_start + lane);
  hn::Store(middle.slope, df, out.middle_slope + lane);
  hn::Store(hn::IfThenElse(hn::Eq(middle.height, none), none, middle.reciprocal), df,
            out.middle_reciprocal + lane);
  hn::Store(hn::IfThenElse(hn::Lt(middle.height, none), beyond, before), df, out.middle_left + lane);
  hn::Store(hn::IfThenElse(hn::Gt(middle.height, none), before, beyond), df, out.middle_right + lane);

  // Planes, operation by operation as in TrianglePlanes.
  const DoubleVector to_bx = hn::Sub(wide_bx, wide_ax), to_by = hn::Sub(wide_by, wide_ay);
  const DoubleVector to_cx = hn::Sub(wide_cx, wide_ax), to_cy = hn::Sub(wide_cy, wide_ay);
  const DoubleVector area = hn::Sub(hn::Mul(to_bx, to_cy), hn::Mul(to_cx, to_by));
  const DoubleVector scale =
      hn::Div(hn::Set(df, static_cast<double>(std::int64_t{1} << (k_plane_fraction_bits + bits))), area);
  const IntVector pixel_x = hn::ShiftRightSame(ax, bits), pixel_y = hn::ShiftRightSame(ay, bits);
  const DoubleVector small = hn::Set(df, 1.0 / (1 << bits));
  const auto fraction = [&](IntVector v, IntVector pixel) {
    return hn::Mul(wide(hn::Sub(v, hn::ShiftLeftSame(pixel, bits))), small);
  };
  const DoubleVector fraction_x = fraction(ax, pixel_x), fraction_y = fraction(ay, pixel_y);
  const IntVector from_tile_x = hn::Sub(pixel_x, tile_x), from_tile_y = hn::Sub(pixel_y, tile_y);
  hn::Store(from_tile_x, di, out.pixel_x + lane);
  hn::Store(from_tile_y, di, out.pixel_y + lane);
  struct Plane {
    LongVector correction, step_x, step_y;
  };
  const auto plane = [&](IntVector a, IntVector b, IntVector c) -> Plane {
    const DoubleVector to_b = wide(hn::Sub(b, a)), to_c = wide(hn::Sub(c, a));
    const DoubleVector x = hn::Mul(hn::Sub(hn::Mul(to_b, to_cy), hn::Mul(to_c, to_by)), scale);
    const DoubleVector y = hn::Mul(hn::Sub(hn::Mul(to_c, to_bx), hn::Mul(to_b, to_cx)), scale);
    return {nearest_integer(hn::Add(hn::Mul(x, fraction_x), hn::Mul(y, fraction_y))), nearest_integer(x),
            nearest_integer(y)};
  };
  {
    const Plane p = plane(az, bz, cz);
    const LongVector a = hn::ShiftLeft<k_plane_fraction_bits>(hn::PromoteTo(dl, az));
    hn::Store(hn::Sub(hn::Add(a, hn::Set(dl, k_plane_half)), p.correction), dl, out.depth + lane);
    hn::Store(p.step_x, dl, out.depth_x + lane);
    hn::Store(p.step_y, dl, out.depth_y + lane);
  }
  if (numbered) return;
  const WordVector start_x = hn::BitCast(dw, from_tile_x), start_y = hn::BitCast(dw, from_tile_y);
  const WordVector byte = hn::Set(dw, 255u);
  const auto words = [lane](const std::uint32_t* p) { return hn::Load(dw, p + lane); };
  const WordVector a = words(block.color[0]), b = words(block.color[1]), c = words(block.color[2]);
  for (int channel = 0; channel < 3; ++channel) {
    const auto component = [&](WordVector v) {
      return hn::BitCast(di, hn::And(hn::ShiftRightSame(v, 8 * channel), byte));
    };
    const IntVector first = component(a);
    const Plane p = plane(first, component(b), component(c));
    const WordVector step_x = low_words(p.step_x), step_y = low_words(p.step_y);
    const WordVector at_a = hn::Sub(hn::Add(hn::ShiftLeft<k_plane_fraction_bits>(hn::BitCast(dw, first)),
                                            hn::Set(dw, static_cast<std::uint32_t>(k_plane_half))),
                                    low_words(p.correction));
    const WordVector at_tile = hn::Sub(at_a, hn::Add(hn::Mul(start_x, step_x), hn::Mul(start_y, step_y)));
    hn::Store(at_tile, dw, out.color[channel] + lane);
    hn::Store(step_x, dw, out.color_x[channel] + lane);
    hn::Store(step_y, dw, out.color_y[channel] + lane);
  }
}

/// 0 1 2 ..., as the tag's lanes.
HWY_INLINE IntVector lane_numbers() {
  return hn::Iota(di, 0);
}

/// v times 0 1 2 .. 7: no vector of 64-bit products is needed.
HWY_INLINE LongVector multiples(std::int64_t v) {
  const LongVector lane = hn::PromoteTo(dl, lane_numbers());
  const LongVector one = hn::Set(dl, v);
  LongVector sum = hn::IfThenElseZero(hn::Ne(hn::And(lane, hn::Set(dl, 1)), hn::Zero(dl)), one);
  if (k_lanes > 2) {
    const LongVector two = hn::Add(one, one);
    sum = hn::Add(sum, hn::IfThenElseZero(hn::Ne(hn::And(lane, hn::Set(dl, 2)), hn::Zero(dl)), two));
    if (k_lanes > 4) {
      const LongVector four = hn::Add(two, two);
      sum = hn::Add(sum, hn::IfThenElseZero(hn::Ne(hn::And(lane, hn::Set(dl, 4)), hn::Zero(dl)), four));
    }
  }
  return sum;
}

/// Depths of fixed-point values.
HWY_INLINE IntVector whole(LongVector v) {
  return hn::BitCast(di, hn::TruncateTo(dw, hn::ShiftRight<k_plane_fraction_bits>(hn::BitCast(dul, v))));
}

HWY_INLINE WordVector pack(WordVector r, WordVector g, WordVector b) {
  return hn::Or(hn::ShiftRight<24>(r), hn::Or(hn::And(hn::ShiftRight<16>(g), hn::Set(dw, 0xFF00u)),
                                              hn::And(hn::ShiftRight<8>(b), hn::Set(dw, 0xFF0000u))));
}

/// First and end columns of rows `row` .. `row` + k_lanes - 1 of triangle i; rows that it does not meet, and
/// nothing else, may be wrong.
HWY_INLINE void cross_rows(const SetUp& s, int i, int row, int width, IntVector& first, IntVector& end) {
  const DoubleVector j = hn::Add(hn::Iota(df, 0), hn::Set(df, static_cast<double>(row)));
  const DoubleVector bias = hn::Set(df, k_crossing_bias);
  const auto crossing = [&](const double* start, const double* slope, const double* reciprocal) {
    const DoubleVector n = hn::Add(hn::Set(df, start[i]), hn::Mul(hn::Set(df, slope[i]), j));
    return hn::Ceil(hn::Sub(hn::Mul(n, hn::Set(df, reciprocal[i])), bias));
  };
  const DoubleVector middle = crossing(s.middle_start, s.middle_slope, s.middle_reciprocal);
  const DoubleVector left = hn::Max(crossing(s.left_start, s.left_slope, s.left_reciprocal),
                                    hn::Min(middle, hn::Set(df, s.middle_left[i])));
  const DoubleVector right = hn::Min(crossing(s.right_start, s.right_slope, s.right_reciprocal),
                                     hn::Max(middle, hn::Set(df, s.middle_right[i])));
  const DoubleVector low = hn::Zero(df), high = hn::Set(df, static_cast<double>(width));
  first = hn::DemoteTo(di, hn::Min(hn::Max(left, low), high));
  end = hn::DemoteTo(di, hn::Min(hn::Max(right, low), high));
}

/// One triangle after another into a tile.
template <bool k_numbered>
class Drawer {
 public:
  Drawer(const TileTask& task, const SetUp& set_up) : task_(task), s_(set_up) {}

  void draw(int i, std::uint32_t number) {
    const int first_row = s_.first_row[i], end_row = s_.end_row[i];
    const int first_column = s_.first_column[i], end_column = s_.end_column[i];
    if (first_row >= end_row || first_column >= end_column) return;
    if (is_hidden(i, first_row, end_row, first_column, end_column)) return;
    number_ = number;
    if (end_column - first_column <= 8 && end_row - first_row <= 8) {
      draw_small(i, first_row, end_row);
    } else {
      for (int strip = first_row & ~7; strip < end_row; strip += 8) {
        draw_strip(i, strip, std::max(first_row - strip, 0), std::min(end_row - strip, 8));
      }
    }
  }

 private:
  bool is_hidden(int i, int first_row, int end_row, int first_column, int end_column) const {
    const std::int32_t nearest = s_.nearest[i];
    for (int y = first_row >> 3; y <= (end_row - 1) >> 3; ++y) {
      for (int x = first_column >> 3; x <= (end_column - 1) >> 3; ++x) {
        if (nearest < task_.far[k_far_blocks * y + x]) return false;
      }
    }
    return true;
  }

  /// Fixed-point depth at a sample of the tile.
  std::uint64_t depth_at(int i, int x, int y) const {
    return static_cast<std::uint64_t>(s_.depth[i]) +
           static_cast<std::uint64_t>(std::int64_t{x} - s_.pixel_x[i]) *
               static_cast<std::uint64_t>(s_.depth_x[i]) +
           static_cast<std::uint64_t>(std::int64_t{y} - s_.pixel_y[i]) *
               static_cast<std::uint64_t>(s_.depth_y[i]);
  }
  std::uint32_t color_at(int i, int channel, int x, int y) const {
    return s_.color[channel][i] + static_cast<std::uint32_t>(x) * s_.color_x[channel][i] +
           static_cast<std::uint32_t>(y) * s_.color_y[channel][i];
  }

  // At most 8 columns and 8 rows: row by row, from the first covered sample on.
  void draw_small(int i, int first_row, int end_row) {
    alignas(64) std::int32_t first[8], end[8];
    for (int r = 0; r < 8; r += k_lanes) {
      IntVector f, e;
      cross_rows(s_, i, first_row + r, task_.width, f, e);
      hn::Store(f, di, first + r);
      hn::Store(e, di, end + r);
    }
    const LongVector depths = multiples(s_.depth_x[i]);
    const WordVector lanes = hn::BitCast(dw, lane_numbers());
    WordVector steps[3];
    if (!k_numbered) {
      for (int c = 0; c < 3; ++c) steps[c] = hn::Mul(lanes, hn::Set(dw, s_.color_x[c][i]));
    }
    for (int row = first_row; row < end_row; ++row) {
      const int x = first[row - first_row], n = end[row - first_row] - x;
      for (int k = 0; k < n; k += k_lanes) {
        std::int32_t* const depth = task_.depth + k_tile * row + x + k;
        const IntVector z =
            whole(hn::Add(hn::Set(dl, static_cast<std::int64_t>(depth_at(i, x + k, row))), depths));
        const auto passes =
            hn::And(hn::Lt(lane_numbers(), hn::Set(di, n - k)), hn::Lt(z, hn::LoadU(di, depth)));
        if (hn::AllFalse(di, passes)) continue;
        hn::BlendedStore(z, passes, di, depth);
        std::uint32_t* const word = task_.word + k_tile * row + x + k;
        WordVector value;
        if (k_numbered) {
          value = hn::Set(dw, number_);
        } else {
          const auto channel = [&](int c) {
            return hn::Add(hn::Set(dw, color_at(i, c, x + k, row)), steps[c]);
          };
          value = pack(channel(0), channel(1), channel(2));
        }
        hn::BlendedStore(value, hn::RebindMask(dw, passes), dw, word);
      }
    }
  }

  // Rows strip + first .. strip + end - 1, block by block.
  void draw_strip(int i, int strip, int first, int end) {
    alignas(64) std::int32_t starts[8], ends[8];
    int low = k_tile, high = 0;
    for (int r = 0; r < 8; r += k_lanes) {
      IntVector f, e;
      cross_rows(s_, i, strip + r, task_.width, f, e);
      const IntVector row = hn::Add(lane_numbers(), hn::Set(di, r));
      const auto inside = hn::And(hn::Gt(row, hn::Set(di, first - 1)), hn::Lt(row, hn::Set(di, end)));
      const auto covered = hn::And(inside, hn::Lt(f, e));
      f = hn::IfThenElse(covered, f, hn::Set(di, k_tile));
      e = hn::IfThenElseZero(covered, e);
      hn::Store(f, di, starts + r);
      hn::Store(e, di, ends + r);
    }
    int full_low = 0, full_high = k_tile;
    for (int r = 0; r < 8; ++r) {
      low = std::min(low, starts[r]), high = std::max(high, ends[r]);
      full_low = std::max(full_low, starts[r]), full_high = std::min(full_high, ends[r]);
    }
    if (low >= high) return;
    const std::int64_t step_x = s_.depth_x[i], step_y = s_.depth_y[i];
    // From the block's first sample to its nearest one.
    const std::int64_t to_nearest =
        7 * std::min<std::int64_t>(step_x, 0) + 7 * std::min<std::int64_t>(step_y, 0);
    std::int64_t at = static_cast<std::int64_t>(depth_at(i, low & ~7, strip));
    std::int32_t* const far = task_.far + k_far_blocks * (strip >> 3);
    for (int x = low & ~7; x < high; x += 8, at += 8 * step_x) {
      const auto nearest = static_cast<std::int32_t>((at + to_nearest) >> k_plane_fraction_bits);
      if (std::max(nearest, s_.nearest[i]) >= far[x >> 3]) continue;
      if (x >= full_low && x + 8 <= full_high) {
        draw_block<true>(i, x, strip, at, starts, ends, far[x >> 3]);
      } else {
        draw_block<false>(i, x, strip, at, starts, ends, far[x >> 3]);
      }
    }
  }

  template <bool k_full>
  void draw_block(int i, int x, int y, std::int64_t at, const std::int32_t* starts, const std::int32_t* ends,
                  std::int32_t& far) {
    IntVector farthest = hn::Set(di, -1);
    bool any = false;
    for (int k = 0; k < 8; k += k_lanes) {
      std::int32_t* const depth = task_.depth + k_tile * y + x + k;
      std::uint32_t* const word = task_.word + k_tile * y + x + k;
      LongVector fixed = hn::Add(hn::Set(dl, at + k * s_.depth_x[i]), multiples(s_.depth_x[i]));
      const LongVector down = hn::Set(dl, s_.depth_y[i]);
      const IntVector column = hn::Add(lane_numbers(), hn::Set(di, x + k));
      WordVector color[3], color_down[3];
      if (!k_numbered) {
        const WordVector lanes = hn::BitCast(dw, lane_numbers());
        for (int c = 0; c < 3; ++c) {
          color[c] =
              hn::Add(hn::Mul(lanes, hn::Set(dw, s_.color_x[c][i])), hn::Set(dw, color_at(i, c, x + k, y)));
          color_down[c] = hn::Set(dw, s_.color_y[c][i]);
        }
      }
      for (int r = 0; r < 8; ++r) {
        const IntVector z = whole(fixed);
        const IntVector before = hn::Load(di, depth + k_tile * r);
        auto passes = hn::Lt(z, before);
        if (!k_full) {
          passes = hn::And(passes, hn::And(hn::Gt(column, hn::Set(di, starts[r] - 1)),
                                           hn::Lt(column, hn::Set(di, ends[r]))));
        }
        const IntVector after = hn::IfThenElse(passes, z, before);
        farthest = hn::Max(farthest, after);
        if (!hn::AllFalse(di, passes)) {
          any = true;
          hn::Store(after, di, depth + k_tile * r);
          const WordVector value = k_numbered ? hn::Set(dw, number_) : pack(color[0], color[1], color[2]);
          hn::BlendedStore(value, hn::RebindMask(dw, passes), dw, word + k_tile * r);
        }
        fixed = hn::Add(fixed, down);
        if (!k_numbered) {
          for (int c = 0; c < 3; ++c) color[c] = hn::Add(color[c], color_down[c]);
        }
      }
    }
    if (any) far = hn::GetLane(hn::MaxOfLanes(di, farthest));
  }

  const TileTask& task_;
  const SetUp& s_;
  std::uint32_t number_ = 0;
};

std::int32_t farthest_of_tile(const TileTask& task) {
  IntVector farthest = hn::Set(di, -1);
  for (int k = 0; k < k_far_blocks * k_far_blocks; k += k_lanes) {
    farthest = hn::Max(farthest, hn::Load(di, task.far + k));
  }
  return hn::GetLane(hn::MaxOfLanes(di, farthest));
}

template <bool k_numbered>
void draw_chain(const TileTask& task, const Bin& bin, std::uint32_t number) {
  SetUp set_up;
  Drawer<k_numbered> drawer(task, set_up);
  for (const TriangleBlock* block = bin.first; block != nullptr; block = block->next) {
    const int count = static_cast<int>(block->next == nullptr ? bin.in_last : k_block);
    const std::int32_t farthest = farthest_of_tile(task);
    for (int lane = 0; lane < count; lane += k_lanes) {
      set_up_lanes(task, *block, k_numbered, lane, set_up);
    }
    for (int i = 0; i < count; ++i, ++number) {
      if (block->z[0][i] == k_special) {
        task.special(task.context, block->source[i]);
      } else if (set_up.nearest[i] < farthest) {
        drawer.draw(i, number);
      }
    }
  }
}

void draw_bin_here(const TileTask& task, const Bin& bin, std::uint32_t first_number) {
  if (task.numbered) {
    draw_chain<true>(task, bin, first_number);
  } else {
    draw_chain<false>(task, bin, first_number);
  }
}

void clear_tile_here(const TileTask& task, std::uint32_t word) {
  std::fill_n(task.depth, k_tile * k_tile + k_tile_padding, task.empty_depth);
  std::fill_n(task.word, k_tile * k_tile + k_tile_padding, word);
  std::fill_n(task.far, k_far_blocks * k_far_blocks, task.empty_depth);
  if (task.width == k_tile && task.height == k_tile) return;
  for (int y = 0; y < k_tile; ++y) {
    const int first = y < task.height ? task.width : 0;
    std::fill(task.depth + k_tile * y + first, task.depth + k_tile * (y + 1), -1);
  }
  for (int y = 0; y < k_far_blocks; ++y) {
    for (int x = 0; x < k_far_blocks; ++x) {
      if (8 * x >= task.width || 8 * y >= task.height) task.far[k_far_blocks * y + x] = -1;
    }
  }
}

void words_to_rgb_here(const std::uint32_t* words, int count, std::uint8_t* rgb) {
  int i = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::FixedTag<std::uint8_t, 16> db;
  alignas(16) static constexpr std::uint8_t k_order[16] = {0,  1,  2,  4,  5, 6, 8,  9,
                                                           10, 12, 13, 14, 3, 7, 11, 15};
  const auto order = hn::Load(db, k_order);
  for (; i + 6 <= count; i += 4) {  // writes four bytes too many each time
    const auto four = hn::LoadU(db, reinterpret_cast<const std::uint8_t*>(words + i));
    hn::StoreU(hn::TableLookupBytes(four, order), db, rgb + 3 * i);
  }
#endif
  for (; i < count; ++i) {
    rgb[3 * i] = static_cast<std::uint8_t>(words[i]);
    rgb[3 * i + 1] = static_cast<std::uint8_t>(words[i] >> 8);
    rgb[3 * i + 2] = static_cast<std::uint8_t>(words[i] >> 16);
  }
}

}  // namespace
}  // namespace farop::tiled::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace farop::tiled {

HWY_EXPORT(clear_tile_here);
HWY_EXPORT(draw_bin_here);
HWY_EXPORT(words_to_rgb_here);

void clear_tile(const TileTask& task, std::uint32_t word) {
  HWY_DYNAMIC_DISPATCH(clear_tile_here)(task, word);
}

void draw_bin(const TileTask& task, const Bin& bin, std::uint32_t first_number) {
  HWY_DYNAMIC_DISPATCH(draw_bin_here)(task, bin, first_number);
}

void words_to_rgb(const std::uint32_t* words, int count, std::uint8_t* rgb) {
  HWY_DYNAMIC_DISPATCH(words_to_rgb_here)(words, count, rgb);
}

}  // namespace farop::tiled
#endif
