// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors whose length is not known before the program runs cannot be members.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/tiled/kernels.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first, so that highway.h is read once per target.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "raster/tiled/kernels.h"
#include "raster/triangle_planes.h"

HWY_BEFORE_NAMESPACE();
namespace farop::tiled::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// At most 8 rows, or triangles, at once.
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

// Rows are drawn with whole vectors of 32-bit lanes.
#if HWY_TARGET == HWY_SCALAR
using WideInts = Ints;
using WideWords = Words;
#else
using WideInts = hn::Repartition<std::int32_t, Doubles>;
using WideWords = hn::Repartition<std::uint32_t, Doubles>;
#endif
constexpr WideInts dwi;
constexpr WideWords dww;
using WideIntVector = hn::Vec<WideInts>;
using WideWordVector = hn::Vec<WideWords>;
constexpr int k_wide = static_cast<int>(hn::MaxLanes(WideInts()));
constexpr int k_wide_parts = k_wide / k_lanes;
/// Shift that brings the whole part of a fixed-point depth into the upper half of 64 bits.
constexpr int k_to_upper = 32 - k_plane_fraction_bits;

/// Larger than every column.
constexpr double k_beyond = 1e9;
/// See triangle_planes.cpp.
constexpr double k_to_integer = 0x1.8p52;
/// Crossings of columns below 2^16 err by less than 2^-36 and are whole or at least 2^-31 beyond.
constexpr double k_crossing_bias = 0x1p-34;

/// Triangles with so many rows and columns at most are drawn without a branch, a vector a row.
constexpr int k_tiny_rows = 8, k_tiny_columns = std::max(k_wide, 8);

/// Triangles that are set up together.
constexpr int k_group = 16;

/// Entries in structure of arrays, as setting up loads them.
struct alignas(64) Group {
  std::int32_t x[3][k_group], y[3][k_group], z[3][k_group];
  std::uint32_t color[3][k_group];
};

/// The constants of 16 triangles, one array a constant.
struct alignas(64) SetUp {
  // An edge crosses row j of the tile at column (start + j * slope) * reciprocal.
  double left_start[k_group], left_slope[k_group], left_reciprocal[k_group];
  double right_start[k_group], right_slope[k_group], right_reciprocal[k_group];
  double middle_start[k_group], middle_slope[k_group], middle_reciprocal[k_group];
  double middle_left[k_group];   ///< +beyond where the middle edge bounds the left side, else -beyond
  double middle_right[k_group];  ///< -beyond where it bounds the right side, else +beyond
  // At the tile's first sample, and from sample to sample.
  std::int64_t depth[k_group], depth_x[k_group], depth_y[k_group];
  std::uint32_t color[3][k_group], color_x[3][k_group], color_y[3][k_group];
  std::int32_t first_row[k_group], end_row[k_group], first_column[k_group], end_column[k_group];
  std::int32_t nearest[k_group];
  /// Rows that the tiny arrays have: no tiny triangle set up together with this one has more.
  std::int32_t tiny_rows[k_group];
  // Of triangles with at most k_tiny_rows rows: covered columns, from first_row on; none: end <= first.
  std::int32_t tiny_first[k_tiny_rows][k_group], tiny_end[k_tiny_rows][k_group];
  /// At the first covered sample, whole part above; then the next row.
  std::int64_t tiny_depth[k_tiny_rows * k_group];
  /// At the first covered sample.
  std::uint32_t tiny_color[3][k_tiny_rows * k_group];
};

HWY_INLINE LongVector nearest_integer(DoubleVector v) {
  const DoubleVector shift = hn::Set(df, k_to_integer);
  return hn::Sub(hn::BitCast(dl, hn::Add(v, shift)), hn::BitCast(dl, shift));
}

HWY_INLINE WordVector low_words(LongVector v) {
  return hn::TruncateTo(dw, hn::BitCast(dul, v));
}

/// Products modulo 2^64.
HWY_INLINE LongVector multiply(LongVector a, LongVector b) {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  return LongVector{_mm512_mullo_epi64(a.raw, b.raw)};
#elif HWY_TARGET == HWY_SCALAR
  return hn::Set(dl, static_cast<std::int64_t>(static_cast<std::uint64_t>(hn::GetLane(a)) *
                                               static_cast<std::uint64_t>(hn::GetLane(b))));
#else
  const hn::Repartition<std::uint32_t, Longs> halves;
  const auto low = [&](LongVector v) { return hn::BitCast(halves, v); };
  const auto high = [&](LongVector v) {
    return hn::BitCast(halves, hn::ShiftRight<32>(hn::BitCast(dul, v)));
  };
  const auto cross = hn::Add(hn::MulEven(low(a), high(b)), hn::MulEven(high(a), low(b)));
  return hn::BitCast(dl, hn::Add(hn::MulEven(low(a), low(b)), hn::ShiftLeft<32>(cross)));
#endif
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

struct Columns {
  IntVector first, end;
};

/// First and end column of one row a lane; rows that a triangle does not meet, and nothing else, may be
/// wrong.
HWY_INLINE Columns cross(DoubleVector row, const EdgeConstants& left, const EdgeConstants& right,
                         const EdgeConstants& middle, DoubleVector middle_left, DoubleVector middle_right,
                         int width) {
  const DoubleVector bias = hn::Set(df, k_crossing_bias);
  const auto crossing = [&](const EdgeConstants& e) {
    const DoubleVector n = hn::Add(e.start, hn::Mul(e.slope, row));
    return hn::Ceil(hn::Sub(hn::Mul(n, e.reciprocal), bias));
  };
  const DoubleVector at_middle = crossing(middle);
  const DoubleVector first = hn::Max(crossing(left), hn::Min(at_middle, middle_left));
  const DoubleVector end = hn::Min(crossing(right), hn::Max(at_middle, middle_right));
  const DoubleVector low = hn::Zero(df), high = hn::Set(df, static_cast<double>(width));
  return {hn::DemoteTo(di, hn::Min(hn::Max(first, low), high)),
          hn::DemoteTo(di, hn::Min(hn::Max(end, low), high))};
}

/// Sets up entries `lane` .. `lane` + k_lanes - 1 of a block.
HWY_INLINE void set_up_lanes(const TileTask& task, const Group& block, bool colors, int lane, SetUp& out) {
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
  const IntVector first_row = hn::Max(hn::Sub(at_or_after(ay), tile_y), zero);
  const IntVector end_row = hn::Min(hn::Sub(at_or_after(hn::Max(by, cy)), tile_y), hn::Set(di, task.height));
  hn::Store(first_row, di, out.first_row + lane);
  hn::Store(end_row, di, out.end_row + lane);
  const IntVector first_column = hn::Max(hn::Sub(at_or_after(low_x), tile_x), zero);
  const IntVector end_column = hn::Min(hn::Sub(at_or_after(high_x), tile_x), hn::Set(di, task.width));
  hn::Store(first_column, di, out.first_column + lane);
  hn::Store(end_column, di, out.end_column + lane);
  const IntVector rows = hn::Sub(end_row, first_row);
  const auto is_tiny = hn::And(hn::Lt(rows, hn::Set(di, k_tiny_rows + 1)),
                               hn::Lt(hn::Sub(end_column, first_column), hn::Set(di, k_tiny_columns + 1)));
  const IntVector most_rows = hn::MaxOfLanes(di, hn::Max(hn::IfThenElseZero(is_tiny, rows), zero));
  hn::Store(most_rows, di, out.tiny_rows + lane);
  const int tiny_rows = hn::GetLane(most_rows);
  hn::Store(hn::Min(az, hn::Min(bz, cz)), di, out.nearest + lane);

  // Edges: a-c on the left, a-b on the right, b-c above them.
  const DoubleVector unit = hn::Set(df, static_cast<double>(1 << bits));
  const DoubleVector column = hn::Set(df, static_cast<double>(task.x));
  const DoubleVector row = hn::Set(df, static_cast<double>(task.y << bits));
  const DoubleVector wide_ax = wide(ax), wide_bx = wide(bx), wide_cx = wide(cx);
  const DoubleVector wide_ay = wide(ay), wide_by = wide(by), wide_cy = wide(cy);
  const DoubleVector none = hn::Zero(df), beyond = hn::Set(df, k_beyond), before = hn::Set(df, -k_beyond);
  EdgeConstants left = edge(wide_ax, wide_ay, wide_cx, wide_cy, column, row, unit);
  EdgeConstants right = edge(wide_ax, wide_ay, wide_bx, wide_by, column, row, unit);
  const auto level = hn::Eq(right.height, none);  // bounds nothing then
  right.start = hn::IfThenElse(level, beyond, right.start);
  right.slope = hn::IfThenElse(level, none, right.slope);
  right.reciprocal = hn::IfThenElse(level, hn::Set(df, 1.0), right.reciprocal);
  EdgeConstants middle = edge(wide_bx, wide_by, wide_cx, wide_cy, column, row, unit);
  middle.reciprocal = hn::IfThenElse(hn::Eq(middle.height, none), none, middle.reciprocal);
  const DoubleVector middle_left = hn::IfThenElse(hn::Lt(middle.height, none), beyond, before);
  const DoubleVector middle_right = hn::IfThenElse(hn::Gt(middle.height, none), before, beyond);
  const auto store_edge = [lane](const EdgeConstants& e, double* start, double* slope, double* reciprocal) {
    hn::Store(e.start, df, start + lane);
    hn::Store(e.slope, df, slope + lane);
    hn::Store(e.reciprocal, df, reciprocal + lane);
  };
  store_edge(left, out.left_start, out.left_slope, out.left_reciprocal);
  store_edge(right, out.right_start, out.right_slope, out.right_reciprocal);
  store_edge(middle, out.middle_start, out.middle_slope, out.middle_reciprocal);
  hn::Store(middle_left, df, out.middle_left + lane);
  hn::Store(middle_right, df, out.middle_right + lane);
  IntVector tiny_first[k_tiny_rows];
  for (int r = 0; r < tiny_rows; ++r) {
    const IntVector j = hn::Add(first_row, hn::Set(di, r));
    const Columns c = cross(wide(j), left, right, middle, middle_left, middle_right, task.width);
    tiny_first[r] = c.first;
    hn::Store(c.first, di, out.tiny_first[r] + lane);
    hn::Store(hn::IfThenElseZero(hn::Lt(j, end_row), c.end), di, out.tiny_end[r] + lane);
  }

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
    const LongVector at_a = hn::Sub(hn::Add(a, hn::Set(dl, k_plane_half)), p.correction);
    const auto times = [](LongVector step, IntVector n) { return multiply(step, hn::PromoteTo(dl, n)); };
    const LongVector at_tile =
        hn::Sub(at_a, hn::Add(times(p.step_x, from_tile_x), times(p.step_y, from_tile_y)));
    hn::Store(at_tile, dl, out.depth + lane);
    hn::Store(p.step_x, dl, out.depth_x + lane);
    hn::Store(p.step_y, dl, out.depth_y + lane);
    LongVector at_row = hn::Add(at_tile, times(p.step_y, first_row));
    for (int r = 0; r < tiny_rows; ++r) {
      const LongVector there = hn::Add(at_row, times(p.step_x, tiny_first[r]));
      hn::Store(hn::ShiftLeft<k_to_upper>(there), dl, out.tiny_depth + k_group * r + lane);
      at_row = hn::Add(at_row, p.step_y);
    }
  }
  if (!colors) return;
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
    WordVector at_row = hn::Add(at_tile, hn::Mul(step_y, hn::BitCast(dw, first_row)));
    for (int r = 0; r < tiny_rows; ++r) {
      hn::Store(hn::Add(at_row, hn::Mul(step_x, hn::BitCast(dw, tiny_first[r]))), dw,
                out.tiny_color[channel] + k_group * r + lane);
      at_row = hn::Add(at_row, step_y);
    }
  }
}

/// 0 1 2 ..., as the tag's lanes.
HWY_INLINE IntVector lane_numbers() {
  return hn::Iota(di, 0);
}

/// v times 0 1 2 .. 7, modulo 2^64.
HWY_INLINE LongVector multiples(std::int64_t v) {
  return multiply(hn::PromoteTo(dl, lane_numbers()), hn::Set(dl, v));
}

/// Fixed-point depths, whole part in the upper half.
struct WideDepths {
  LongVector part[k_wide_parts];
};

HWY_INLINE WideIntVector whole(const WideDepths& v) {
#if HWY_TARGET == HWY_SCALAR
  return hn::BitCast(di, hn::TruncateTo(dw, hn::ShiftRight<32>(hn::BitCast(dul, v.part[0]))));
#else
  return hn::ConcatOdd(dwi, hn::BitCast(dwi, v.part[1]), hn::BitCast(dwi, v.part[0]));
#endif
}

HWY_INLINE std::int64_t to_upper(std::int64_t fixed) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(fixed) << k_to_upper);
}

/// Modulo 2^64: samples of a vector that a triangle does not cover may lie anywhere.
HWY_INLINE std::int64_t sum(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

/// Colours of fixed-point channels.
HWY_INLINE WideWordVector pack(WideWordVector r, WideWordVector g, WideWordVector b) {
  return hn::Or(hn::ShiftRight<24>(r), hn::Or(hn::And(hn::ShiftRight<16>(g), hn::Set(dww, 0xFF00u)),
                                              hn::And(hn::ShiftRight<8>(b), hn::Set(dww, 0xFF0000u))));
}

/// Of rows `row` .. `row` + k_lanes - 1 of triangle i.
HWY_INLINE Columns cross_rows(const SetUp& s, int i, int row, int width) {
  const auto load = [i](const double* start, const double* slope, const double* reciprocal) -> EdgeConstants {
    return {hn::Set(df, start[i]), hn::Set(df, slope[i]), hn::Zero(df), hn::Set(df, reciprocal[i])};
  };
  const DoubleVector rows = hn::Add(hn::Iota(df, 0), hn::Set(df, static_cast<double>(row)));
  return cross(rows, load(s.left_start, s.left_slope, s.left_reciprocal),
               load(s.right_start, s.right_slope, s.right_reciprocal),
               load(s.middle_start, s.middle_slope, s.middle_reciprocal), hn::Set(df, s.middle_left[i]),
               hn::Set(df, s.middle_right[i]), width);
}

/// Entries of several bins in drawing order.
class Merger {
 public:
  Merger(const Bin* const* bins, int count) {
    for (int k = 0; k < count; ++k) {
      if (bins[k]->first != nullptr) cursors_[count_++] = {bins[k]->first, 0, bins[k]};
    }
  }

  /// Up to k_group entries; 0 behind the last one.
  int next(const TriangleEntry** entries) {
    int n = 0;
    while (n < k_group && count_ > 0) {
      // The first of the bins that have the earliest batch, as long as it stays in that batch.
      int best = 0;
      for (int k = 1; k < count_; ++k) {
        if (cursors_[k].entry().batch < cursors_[best].entry().batch) best = k;
      }
      Cursor& cursor = cursors_[best];
      const std::uint32_t batch = cursor.entry().batch;
      bool ended = false;
      do {
        entries[n++] = &cursor.entry();
        ended = !cursor.step();
      } while (n < k_group && !ended && (count_ == 1 || cursor.entry().batch == batch));
      if (ended) {
        --count_;
        for (int k = best; k < count_; ++k) cursors_[k] = cursors_[k + 1];
      }
    }
    return n;
  }

 private:
  struct Cursor {
    const EntryBlock* block;
    std::uint32_t i;
    const Bin* bin;

    const TriangleEntry& entry() const { return block->entries[i]; }
    bool step() {
      if (++i < (block == bin->last ? bin->in_last : k_block)) return true;
      block = block->next, i = 0;
      if (block == nullptr) return false;
      // Chains jump through memory: no hardware sees that coming.
      if (block->next != nullptr) {
        for (const TriangleEntry& e : block->next->entries) hwy::Prefetch(&e);
        hwy::Prefetch(&block->next->next);
      }
      return true;
    }
  };

  Cursor cursors_[k_max_bins] = {};
  int count_ = 0;
};

/// What is written of opaque samples beside their depths.
enum class Writes : std::uint8_t { colors, numbers, both };

/// One triangle after another into a tile.
template <Writes k_writes>
class Drawer {
 public:
  explicit Drawer(const TileTask& task) : task_(task) {}

  void draw(const Bin* const* bins, int count) {
    Merger merger(bins, count);
    const TriangleEntry* entries[k_group];
    for (int n = merger.next(entries); n > 0; n = merger.next(entries)) {
      if (k_numbers) std::copy_n(entries, n, task_.entries + first_number_);
      draw_group(entries, n);
      first_number_ += static_cast<std::uint32_t>(n);
    }
  }

 private:
  static constexpr bool k_colors = k_writes != Writes::numbers, k_numbers = k_writes != Writes::colors;

  void draw_group(const TriangleEntry* const* entries, int count) {
    for (int i = 0; i < count; ++i) {
      const TriangleEntry& e = *entries[i];
      for (int k = 0; k < 3; ++k) {
        group_.x[k][i] = e.x[k], group_.y[k][i] = e.y[k], group_.z[k][i] = e.z[k];
        group_.color[k][i] = e.color[k];
      }
    }
    const std::int32_t farthest = farthest_of_tile();
    for (int lane = 0; lane < count; lane += k_lanes) set_up_lanes(task_, group_, k_colors, lane, s_);
    for (int i = 0; i < count; ++i) {
      if (group_.z[0][i] == k_special) {
        draw_rows();
        task_.special(task_.context, *entries[i]);
        continue;
      }
      if (group_.z[0][i] == k_spans) {
        if (group_.z[1][i] >= farthest) continue;
        draw_rows();
        draw_spans(*entries[i]);
        continue;
      }
      if (s_.nearest[i] >= farthest) continue;
      const int rows = s_.end_row[i] - s_.first_row[i], columns = s_.end_column[i] - s_.first_column[i];
      if (k_numbers && entries[i]->transparent != 0) {
        draw_rows();
        if (rows > 0 && columns > 0) draw_strips<true>(i);
      } else if (rows <= k_tiny_rows && columns <= k_tiny_columns) {
        if (rows > 0 && columns > 0) add_tiny(i);
      } else if (rows > 0 && columns > 0) {
        draw_rows();
        draw_strips<false>(i);
      }
    }
    draw_rows();
  }

  /// Covered samples of a row of a tiny triangle.
  struct Row {
    std::int32_t triangle;
    std::int32_t slot;    ///< in tiny_depth and tiny_color
    std::int32_t sample;  ///< of the tile, the first one covered
    std::int32_t count;
  };
  /// What a triangle has at a sample, and how it grows along the lanes.
  struct Lanes {
    WideDepths depth;
    WideWordVector color[3];
  };

  Lanes lanes_of(int i) const {
    Lanes lanes;
    const std::int64_t step = to_upper(s_.depth_x[i]);
    const LongVector first = multiples(step);
    for (int k = 0; k < k_wide_parts; ++k)
      lanes.depth.part[k] = hn::Add(first, hn::Set(dl, k * k_lanes * step));
    if (k_colors) {
      const WideWordVector numbers = hn::Iota(dww, 0);
      for (int c = 0; c < 3; ++c) lanes.color[c] = hn::Mul(numbers, hn::Set(dww, s_.color_x[c][i]));
    }
    return lanes;
  }

  std::int32_t farthest_of_tile() {
    refresh_far();
    IntVector farthest = hn::Set(di, -1);
    for (int k = 0; k < k_far_blocks * k_far_blocks; k += k_lanes) {
      farthest = hn::Max(farthest, hn::Load(di, task_.far + k));
    }
    return hn::GetLane(hn::MaxOfLanes(di, farthest));
  }

  // Blocks into which much was drawn row by row: their farthest depth may have come nearer.
  void refresh_far() {
    if (changed_ < k_refresh) return;
    changed_ = 0;
    for (int b = 0; b < k_far_blocks * k_far_blocks; ++b) {
      if (drawn_[b] < k_refresh) continue;
      drawn_[b] = 0;
      look_up_far(b);
    }
  }

  void look_up_far(int b) {
    const std::int32_t* const depth = task_.depth + 8 * k_tile * (b / k_far_blocks) + 8 * (b % k_far_blocks);
    IntVector farthest = hn::Set(di, -1);
    for (int r = 0; r < 8; ++r) {
      for (int k = 0; k < 8; k += k_lanes) {
        farthest = hn::Max(farthest, hn::Load(di, depth + k_tile * r + k));
      }
    }
    task_.far[b] = hn::GetLane(hn::MaxOfLanes(di, farthest));
  }

  void has_drawn(int block, int rows) {
    drawn_[block] += rows;
    changed_ += rows;
  }

  // A tiny triangle: notes its rows, without a branch that depends on it.
  void add_tiny(int i) {
    const int x = s_.first_column[i], y = s_.first_row[i];
    const int left = x >> 3, right = (s_.end_column[i] - 1) >> 3, middle = std::min(left + 1, right);
    const int low = k_far_blocks * (y >> 3), high = k_far_blocks * ((s_.end_row[i] - 1) >> 3);
    const auto farther = [this](int b, int c) { return std::max(task_.far[b], task_.far[c]); };
    const std::int32_t farthest =
        std::max(std::max(farther(low + left, low + middle), farther(high + left, high + middle)),
                 farther(low + right, high + right));
    const bool seen = s_.nearest[i] < farthest;
    has_drawn(low + left, seen ? 2 : 0);
    int rows = row_count_;
    for (int r = 0; r < s_.tiny_rows[i]; ++r) {
      const std::int32_t first = s_.tiny_first[r][i], count = s_.tiny_end[r][i] - first;
      rows_[rows] = {i, k_group * r + i, k_tile * (y + r) + first, count};
      rows += static_cast<int>(count > 0) & static_cast<int>(seen);
    }
    row_count_ = rows;
  }

  void draw_rows() {
    const std::int64_t* const depths = s_.tiny_depth;
    const int count = row_count_;  // in a register: the loop writes to memory
    row_count_ = 0;
    for (int k = 0; k < count; ++k) {
      const Row& row = rows_[k];
      const int i = row.triangle;
      const Lanes lanes = lanes_of(i);
      const std::uint32_t color[3] = {s_.tiny_color[0][row.slot], s_.tiny_color[1][row.slot],
                                      s_.tiny_color[2][row.slot]};
      draw_row<false, k_tiny_columns>(i, row.sample, row.count, depths[row.slot], color, lanes);
    }
  }

  // `count` samples, k_most at most, from one on whose values are given.
  template <bool k_transparent, int k_most>
  HWY_INLINE void draw_row(int i, int sample, int count, std::int64_t depth, const std::uint32_t (&color)[3],
                           const Lanes& lanes) {
    for (int x = 0; x < k_most; x += k_wide) {
      if (k_wide < 8 && x >= count) return;
      const auto step = static_cast<std::uint32_t>(x);
      const std::uint32_t there[3] = {color[0] + step * s_.color_x[0][i], color[1] + step * s_.color_x[1][i],
                                      color[2] + step * s_.color_x[2][i]};
      draw_vector<k_transparent>(i, sample + x, count - x, sum(depth, to_upper(x * s_.depth_x[i])), there,
                                 lanes);
    }
  }

  // `count` samples, k_wide at most.
  template <bool k_transparent>
  HWY_INLINE void draw_vector(int i, int sample, int count, std::int64_t depth_there,
                              const std::uint32_t (&color_there)[3], const Lanes& lanes) {
    std::int32_t* const depth = task_.depth + sample;
    WideDepths fixed;
    for (int k = 0; k < k_wide_parts; ++k) {
      fixed.part[k] = hn::Add(hn::Set(dl, depth_there), lanes.depth.part[k]);
    }
    const WideIntVector z = whole(fixed), before = hn::LoadU(dwi, depth);
    const auto passes = hn::And(hn::Lt(hn::Iota(dwi, 0), hn::Set(dwi, count)), hn::Lt(z, before));
    const std::uint32_t number = first_number_ + static_cast<std::uint32_t>(i);
    if (k_transparent) {
      add_fragments(dwi, passes, z, number, sample);
      return;
    }
    hn::StoreU(hn::IfThenElse(passes, z, before), dwi, depth);
    const auto put = [&](std::uint32_t* to, WideWordVector value) {
      hn::StoreU(hn::IfThenElse(hn::RebindMask(dww, passes), value, hn::LoadU(dww, to)), dww, to);
    };
    if (k_colors) {
      const auto channel = [&](int c) { return hn::Add(hn::Set(dww, color_there[c]), lanes.color[c]); };
      put(task_.word + sample, pack(channel(0), channel(1), channel(2)));
    }
    if (k_numbers) put(task_.number + sample, hn::Set(dww, number));
  }

  // Where `passes`, of the samples from `sample` on.
  template <class D, class Mask>
  HWY_INLINE void add_fragments(D d, Mask passes, hn::Vec<D> z, std::uint32_t number, int sample) {
    alignas(64) std::int32_t depths[hn::MaxLanes(D())];
    alignas(8) std::uint8_t bits[8] = {};
    if (hn::StoreMaskBits(d, passes, bits) == 0) return;
    hn::Store(z, d, depths);
    unsigned rest = bits[0] | static_cast<unsigned>(bits[1]) << 8;
    for (; rest != 0; rest &= rest - 1) {
      const int lane = std::countr_zero(rest);
      task_.fragments->add({number, depths[lane], static_cast<std::uint32_t>(sample + lane)});
    }
  }

  // Pieces of spans, by the formulas of PolygonFiller::OnSpan.
  void draw_spans(const TriangleEntry& entry) {
    const KeptSpans& kept = *task_.spans[entry.portion];
    const auto first = static_cast<std::uint32_t>(entry.x[0]), count = static_cast<std::uint32_t>(entry.x[1]);
    const std::uint32_t numbers = k_piece_bit | std::uint32_t{entry.portion} << k_portion_shift;
    const bool transparent = k_numbers && entry.transparent != 0;
    for (std::uint32_t p = first; p < first + count; ++p) {
      const SpanPiece& piece = kept.pieces[p];
      const KeptSpan& span = kept.spans[piece.span];
      if (transparent) {
        draw_piece<true>(piece, span, numbers | p);
      } else if (span.color.slope == V3d(0, 0, 0)) {
        draw_piece<false, true>(piece, span, numbers | p);
      } else {
        draw_piece<false>(piece, span, numbers | p);
      }
    }
  }

  template <bool k_transparent, bool k_one_color = false>
  HWY_INLINE void draw_piece(const SpanPiece& piece, const KeptSpan& span, std::uint32_t number) {
    const DoubleVector rest = hn::Set(df, span.left_rest);
    const DoubleVector z_start = hn::Set(df, span.depth.start), z_slope = hn::Set(df, span.depth.slope);
    const DoubleVector half = hn::Set(df, 0.5), most = hn::Set(df, 255.0);
    const hn::Rebind<float, Doubles> dfl;
    const double left = static_cast<double>(task_.x) - span.left_column;
    const int row = k_tile * piece.row;
    for (int x = piece.first; x < piece.end; x += k_lanes) {
      const int sample = row + x;
      const DoubleVector distance = hn::Add(hn::Add(hn::Iota(df, 0), hn::Set(df, left + x)), rest);
      const auto along = [&](DoubleVector start, DoubleVector slope) {
        return hn::Add(start, hn::Mul(slope, distance));
      };
      const IntVector z = hn::DemoteTo(di, along(z_start, z_slope));
      std::int32_t* const depth = task_.depth + sample;
      const IntVector before = hn::LoadU(di, depth);
      const auto passes = hn::And(hn::Lt(lane_numbers(), hn::Set(di, piece.end - x)), hn::Lt(z, before));
      if (k_transparent) {
        add_fragments(di, passes, z, number, sample);
        continue;
      }
      if (hn::AllFalse(di, passes)) continue;
      hn::StoreU(hn::IfThenElse(passes, z, before), di, depth);
      const auto put = [&](std::uint32_t* to, WordVector value) {
        hn::StoreU(hn::IfThenElse(hn::RebindMask(dw, passes), value, hn::LoadU(dw, to)), dw, to);
      };
      if (k_numbers) put(task_.number + sample, hn::Set(dw, number));
      if (!k_colors) continue;
      const auto channel = [&](double start, double slope) {  // to_byte()
        DoubleVector c = k_one_color ? hn::Set(df, start) : along(hn::Set(df, start), hn::Set(df, slope));
        c = hn::PromoteTo(df, hn::DemoteTo(dfl, c));
        return hn::BitCast(dw, hn::DemoteTo(di, hn::Min(hn::Add(c, half), most)));
      };
      const WordVector r = channel(span.color.start.x, span.color.slope.x);
      const WordVector g = channel(span.color.start.y, span.color.slope.y);
      const WordVector b = channel(span.color.start.z, span.color.slope.z);
      put(task_.word + sample, hn::Or(r, hn::Or(hn::ShiftLeft<8>(g), hn::ShiftLeft<16>(b))));
    }
    if (k_transparent) return;
    for (int x = piece.first & ~7; x < piece.end; x += 8)
      has_drawn(k_far_blocks * (piece.row >> 3) + (x >> 3), 1);
  }

  // The triangle is behind all of the 8 x 8 block at (x, y), as far as it can be known in the block.
  bool is_hidden(int i, int x, int y) const {
    const std::int64_t step_x = s_.depth_x[i], step_y = s_.depth_y[i];
    const std::int64_t nearest = s_.depth[i] + x * step_x + y * step_y +
                                 7 * std::min<std::int64_t>(step_x, 0) +
                                 7 * std::min<std::int64_t>(step_y, 0);
    return std::max<std::int64_t>(nearest >> k_plane_fraction_bits, s_.nearest[i]) >=
           task_.far[k_far_blocks * (y >> 3) + (x >> 3)];
  }

  template <bool k_transparent>
  void draw_strips(int i) {
    const int first_row = s_.first_row[i], end_row = s_.end_row[i];
    const Lanes lanes = lanes_of(i);
    const int left = s_.first_column[i] & ~7, right = s_.end_column[i];
    for (int strip = first_row & ~7; strip < end_row; strip += 8) {
      bool seen = false;
      for (int x = left; x < right && !seen; x += 8) seen = !is_hidden(i, x, strip);
      if (!seen) continue;
      draw_strip<k_transparent>(i, strip, std::max(first_row - strip, 0), std::min(end_row - strip, 8),
                                lanes);
    }
  }

  // Rows strip + first .. strip + end - 1.
  template <bool k_transparent>
  HWY_INLINE void draw_strip(int i, int strip, int first, int end, const Lanes& lanes) {
    alignas(64) std::int32_t starts[8], ends[8];
    alignas(64) std::int64_t depths[8];
    alignas(64) std::uint32_t colors[3][8];
    IntVector low = hn::Set(di, k_tile), high = hn::Zero(di);
    IntVector widest = hn::Zero(di);
    const std::int64_t step_x = s_.depth_x[i], step_y = s_.depth_y[i];
    const std::int64_t depth = s_.depth[i] + strip * step_y;
    for (int r = 0; r < 8; r += k_lanes) {
      const Columns c = cross_rows(s_, i, strip + r, task_.width);
      const IntVector row = hn::Add(lane_numbers(), hn::Set(di, r));
      const auto inside = hn::And(hn::Gt(row, hn::Set(di, first - 1)), hn::Lt(row, hn::Set(di, end)));
      const auto covered = hn::And(inside, hn::Lt(c.first, c.end));
      const IntVector f = hn::IfThenElse(covered, c.first, hn::Set(di, k_tile));
      const IntVector e = hn::IfThenElseZero(covered, c.end);
      low = hn::Min(low, f), high = hn::Max(high, e);
      widest = hn::Max(widest, hn::Sub(e, f));
      hn::Store(f, di, starts + r);
      hn::Store(e, di, ends + r);
    }
    const int left = hn::GetLane(hn::MinOfLanes(di, low)), right = hn::GetLane(hn::MaxOfLanes(di, high));
    if (left >= right) return;
    const int widest_row = hn::GetLane(hn::MaxOfLanes(di, widest));
    bool seen = false;
    for (int x = left & ~7; x < right && !seen; x += 8) seen = !is_hidden(i, x, strip);
    if (!seen) return;
    for (int r = 0; r < 8; r += k_lanes) {
      const IntVector start = hn::Load(di, starts + r), row = hn::Add(lane_numbers(), hn::Set(di, r));
      const LongVector there =
          hn::Add(hn::Set(dl, depth), hn::Add(multiply(hn::PromoteTo(dl, start), hn::Set(dl, step_x)),
                                              multiply(hn::PromoteTo(dl, row), hn::Set(dl, step_y))));
      hn::Store(hn::ShiftLeft<k_to_upper>(there), dl, depths + r);
      for (int c = 0; c < 3 && k_colors; ++c) {
        const std::uint32_t down = s_.color_y[c][i];
        hn::Store(hn::Add(hn::Set(dw, s_.color[c][i] + static_cast<std::uint32_t>(strip) * down),
                          hn::Add(hn::Mul(hn::BitCast(dw, start), hn::Set(dw, s_.color_x[c][i])),
                                  hn::Mul(hn::BitCast(dw, row), hn::Set(dw, down)))),
                  dw, colors[c] + r);
      }
    }
    // As many vectors for every row of the strip: a branch on each row's width would be guessed wrong too
    // often.
    const auto draw_rows_of = [&](auto most) {
      for (int r = first; r < end; ++r) {
        const std::uint32_t color[3] = {colors[0][r], colors[1][r], colors[2][r]};
        draw_row<k_transparent, most()>(i, k_tile * (strip + r) + starts[r], ends[r] - starts[r], depths[r],
                                        color, lanes);
      }
    };
    if (widest_row <= 16) {
      draw_rows_of(std::integral_constant<int, 16>());
    } else if (widest_row <= 32) {
      draw_rows_of(std::integral_constant<int, 32>());
    } else if (widest_row <= 48) {
      draw_rows_of(std::integral_constant<int, 48>());
    } else {
      draw_rows_of(std::integral_constant<int, 64>());
    }
    if (!k_transparent && end - first >= k_worth) {
      for (int x = left & ~7; x < right; x += 8) look_up_far(k_far_blocks * (strip >> 3) + (x >> 3));
    }
  }

  /// Rows drawn into a block until its farthest depth is looked up again.
  static constexpr int k_refresh = 16;
  /// Rows of a strip that are likely to bring a block's farthest depth nearer.
  static constexpr int k_worth = 4;

  const TileTask& task_;
  Group group_ = {};
  SetUp s_;
  std::uint32_t first_number_ = 0;
  Row rows_[k_tiny_rows * k_group + 1];
  int row_count_ = 0;
  int drawn_[k_far_blocks * k_far_blocks] = {};
  int changed_ = 0;
};

void draw_bins_here(const TileTask& task, const Bin* const* bins, int count) {
  if (task.number == nullptr) {
    Drawer<Writes::colors>(task).draw(bins, count);
  } else if (task.word == nullptr) {
    Drawer<Writes::numbers>(task).draw(bins, count);
  } else {
    Drawer<Writes::both>(task).draw(bins, count);
  }
}

void clear_tile_here(const TileTask& task, std::uint32_t word, std::uint32_t number) {
  std::fill_n(task.depth, k_tile * k_tile + k_tile_padding, task.empty_depth);
  if (task.word != nullptr) std::fill_n(task.word, k_tile * k_tile + k_tile_padding, word);
  if (task.number != nullptr) std::fill_n(task.number, k_tile * k_tile + k_tile_padding, number);
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
HWY_EXPORT(draw_bins_here);
HWY_EXPORT(words_to_rgb_here);

void clear_tile(const TileTask& task, std::uint32_t word, std::uint32_t number) {
  HWY_DYNAMIC_DISPATCH(clear_tile_here)(task, word, number);
}

void draw_bins(const TileTask& task, const Bin* const* bins, int count) {
  HWY_DYNAMIC_DISPATCH(draw_bins_here)(task, bins, count);
}

void words_to_rgb(const std::uint32_t* words, int count, std::uint8_t* rgb) {
  HWY_DYNAMIC_DISPATCH(words_to_rgb_here)(words, count, rgb);
}

}  // namespace farop::tiled
#endif
