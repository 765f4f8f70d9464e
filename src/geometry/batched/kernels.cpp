// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors whose length is not known before the program runs cannot be members.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/batched/kernels.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first, so that highway.h is read once per target.
#include <hwy/highway.h>

#include <limits>

#include "geometry/batched/kernels.h"
#include "shading/power.h"

HWY_BEFORE_NAMESPACE();
namespace farop::batched::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, k_lanes>;
using UnsignedLongs = hn::RebindToUnsigned<Doubles>;
using Ints = hn::Rebind<std::int32_t, Doubles>;
using Words = hn::Rebind<std::uint32_t, Doubles>;
constexpr Doubles df;
constexpr UnsignedLongs dul;
constexpr Ints di;
constexpr Words dw;
using Vector = hn::Vec<Doubles>;
using LongVector = hn::Vec<UnsignedLongs>;
using IntVector = hn::Vec<Ints>;
using MaskVector = hn::Mask<Doubles>;

constexpr std::size_t k_step = hn::MaxLanes(Doubles());

HWY_INLINE Vector set(double v) {
  return hn::Set(df, v);
}

/// Three coordinates of several points.
struct Three {
  Vector x, y, z;
};

HWY_INLINE Three load(const PointArrays& a, std::size_t i) {
  return {hn::Load(df, a.x + i), hn::Load(df, a.y + i), hn::Load(df, a.z + i)};
}

HWY_INLINE void store(const Three& v, const PointArrays& a, std::size_t i) {
  hn::Store(v.x, df, a.x + i);
  hn::Store(v.y, df, a.y + i);
  hn::Store(v.z, df, a.z + i);
}

HWY_INLINE Three all(const V3d& v) {
  return {set(v.x), set(v.y), set(v.z)};
}

HWY_INLINE Three operator-(const Three& a, const Three& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vector dot(const Three& a, const Three& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// x a + y b + z c
HWY_INLINE Vector combine(const Three& v, Vector a, Vector b, Vector c) {
  return hn::Add(hn::Add(hn::Mul(v.x, a), hn::Mul(v.y, b)), hn::Mul(v.z, c));
}

/// Squares below this have lost digits: Imath then scales first.
constexpr double k_tiny_square = 2 * std::numeric_limits<double>::min();

HWY_NOINLINE Three normalized_lane_by_lane(const Three& v) {
  alignas(k_alignment) double x[k_step], y[k_step], z[k_step];
  hn::Store(v.x, df, x);
  hn::Store(v.y, df, y);
  hn::Store(v.z, df, z);
  for (std::size_t i = 0; i < k_step; ++i) {
    const V3d unit = V3d(x[i], y[i], z[i]).normalized();
    x[i] = unit.x, y[i] = unit.y, z[i] = unit.z;
  }
  return {hn::Load(df, x), hn::Load(df, y), hn::Load(df, z)};
}

HWY_INLINE Three normalized(const Three& v) {
  const Vector square = dot(v, v);
  if (HWY_UNLIKELY(!hn::AllFalse(df, hn::Lt(square, set(k_tiny_square))))) return normalized_lane_by_lane(v);
  const Vector length = hn::Sqrt(square);
  return {hn::Div(v.x, length), hn::Div(v.y, length), hn::Div(v.z, length)};
}

/// std::max(a, b), std::min(a, b): the first if neither is larger.
HWY_INLINE Vector larger(Vector a, Vector b) {
  return hn::IfThenElse(hn::Lt(a, b), b, a);
}
HWY_INLINE Vector smaller(Vector a, Vector b) {
  return hn::IfThenElse(hn::Lt(b, a), b, a);
}

HWY_INLINE std::uint32_t bits_of(MaskVector mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(df, mask, bits);
  return bits[0] & ((1u << k_step) - 1);
}

// ------------------------------------------------------------------------------------------------ planes

constexpr double k_infinity = std::numeric_limits<double>::infinity();
/// Of the length of Newell's sum.
constexpr double k_least_area = 1e-12;

/// plane_normal() for the polygons of k_step lanes.
HWY_INLINE void planes_of_lanes(const Row* rows, std::size_t lane, const Three& eye, PlaneGroup& group) {
  const auto corner = [&](std::size_t c) {
    return Three{hn::Load(df, rows[3 * c].values + lane), hn::Load(df, rows[3 * c + 1].values + lane),
                 hn::Load(df, rows[3 * c + 2].values + lane)};
  };
  const std::size_t corners = group.corners;
  const Three origin = corner(0);
  Vector extent = hn::Zero(df);
  for (std::size_t c = 1; c < corners; ++c) {
    const Three d = corner(c) - origin;
    extent = larger(larger(larger(extent, hn::Abs(d.x)), hn::Abs(d.y)), hn::Abs(d.z));
  }
  const MaskVector measurable = hn::And(hn::Gt(extent, hn::Zero(df)), hn::Lt(extent, set(k_infinity)));

  const auto scaled = [&](std::size_t c) {
    const Three d = corner(c) - origin;
    return Three{hn::Div(d.x, extent), hn::Div(d.y, extent), hn::Div(d.z, extent)};
  };
  Three sum{hn::Zero(df), hn::Zero(df), hn::Zero(df)};
  const Three last = scaled(corners - 1);
  Three previous = last;
  for (std::size_t c = 0; c < corners; ++c) {
    Three current{hn::Zero(df), hn::Zero(df), hn::Zero(df)};  // the first corner is the origin
    if (c > 0) current = c + 1 == corners ? last : scaled(c);
    sum.x = hn::Add(sum.x, hn::Mul(hn::Sub(previous.y, current.y), hn::Add(previous.z, current.z)));
    sum.y = hn::Add(sum.y, hn::Mul(hn::Sub(previous.z, current.z), hn::Add(previous.x, current.x)));
    sum.z = hn::Add(sum.z, hn::Mul(hn::Sub(previous.x, current.x), hn::Add(previous.y, current.y)));
    previous = current;
  }
  const Vector length = hn::Sqrt(dot(sum, sum));  // a square that has lost digits is too small in any case
  const MaskVector fine = hn::And(measurable, hn::Gt(length, set(k_least_area)));
  const Three normal{hn::Div(sum.x, length), hn::Div(sum.y, length), hn::Div(sum.z, length)};
  const MaskVector away = hn::Ge(dot(normal, origin - eye), hn::Zero(df));
  store(normal, {group.x, group.y, group.z}, lane);
  group.degenerate |= (bits_of(fine) ^ ((1u << k_step) - 1)) << lane;
  group.faces_away |= bits_of(away) << lane;
}

/// plane_normal() of one long polygon: everything by vectors but the sum, whose order is fixed.
HWY_INLINE void plane_of_long(const Row* rows, const V3d& eye, PlaneGroup& group) {
  constexpr std::size_t room = PlaneGroup::k_longest + 2 * k_lanes;
  const std::size_t n = group.corners, padded = PlaneGroup::rows_of_long(n) * k_lanes;
  const PointArrays corners{const_cast<double*>(rows->values), const_cast<double*>(rows->values) + padded,
                            const_cast<double*>(rows->values) + 2 * padded};
  const V3d first(corners.x[0], corners.y[0], corners.z[0]);
  const Three origin = all(first);
  Vector extents = hn::Zero(df);
  for (std::size_t i = 0; i < n; i += k_step) {
    const Three d = load(corners, i) - origin;
    extents = larger(larger(larger(extents, hn::Abs(d.x)), hn::Abs(d.y)), hn::Abs(d.z));
  }
  alignas(k_alignment) double lanes[k_step];
  hn::Store(extents, df, lanes);
  double extent = 0;
  for (const double e : lanes) extent = extent < e ? e : extent;
  group.degenerate = 1;
  if (!(extent > 0) || !(extent < k_infinity)) return;

  // Scaled corners begin at 1; the last one comes before the first.
  alignas(k_alignment) double x[room], y[room], z[room];
  const Vector size = set(extent);
  for (std::size_t i = 0; i < n; i += k_step) {
    const Three d = load(corners, i) - origin;
    hn::StoreU(hn::Div(d.x, size), df, x + 1 + i);
    hn::StoreU(hn::Div(d.y, size), df, y + 1 + i);
    hn::StoreU(hn::Div(d.z, size), df, z + 1 + i);
  }
  x[0] = x[n], y[0] = y[n], z[0] = z[n];
  for (std::size_t i = 0; i < n; i += k_step) {
    const Three previous{hn::Load(df, x + i), hn::Load(df, y + i), hn::Load(df, z + i)};
    const Three current{hn::LoadU(df, x + 1 + i), hn::LoadU(df, y + 1 + i), hn::LoadU(df, z + 1 + i)};
    hn::Store(hn::Mul(hn::Sub(previous.y, current.y), hn::Add(previous.z, current.z)), df, x + i);
    hn::Store(hn::Mul(hn::Sub(previous.z, current.z), hn::Add(previous.x, current.x)), df, y + i);
    hn::Store(hn::Mul(hn::Sub(previous.x, current.x), hn::Add(previous.y, current.y)), df, z + i);
  }
  V3d sum(0, 0, 0);
  for (std::size_t i = 0; i < n; ++i) sum.x += x[i], sum.y += y[i], sum.z += z[i];
  const double length = sum.length();
  if (!(length > k_least_area)) return;
  const V3d normal = sum / length;
  group.x[0] = normal.x, group.y[0] = normal.y, group.z[0] = normal.z;
  group.degenerate = 0;
  group.faces_away = normal.dot(first - eye) >= 0 ? 1 : 0;
}

void find_planes_here(std::span<PlaneGroup> groups, const Row* rows, const V3d& eye) {
  const Three eyes = all(eye);
  for (PlaneGroup& group : groups) {
    group.degenerate = group.faces_away = 0;
    if (group.is_long) {
      plane_of_long(rows + group.first_row, eye, group);
      continue;
    }
    for (std::size_t lane = 0; lane < k_lanes; lane += k_step)
      planes_of_lanes(rows + group.first_row, lane, eyes, group);
  }
}

// ----------------------------------------------------------------------------------------------- vertices

std::uint32_t transform_points_here(const M44d& m, const Frustum& frustum, std::size_t n, PointArrays points,
                                    std::uint32_t* codes) {
  const Three row0{set(m[0][0]), set(m[0][1]), set(m[0][2])};
  const Three row1{set(m[1][0]), set(m[1][1]), set(m[1][2])};
  const Three row2{set(m[2][0]), set(m[2][1]), set(m[2][2])};
  const Three row3{set(m[3][0]), set(m[3][1]), set(m[3][2])};
  const Vector tan_x = set(frustum.tan_x), tan_y = set(frustum.tan_y);
  const Vector hither = set(frustum.hither), yon = set(frustum.yon);
  // Bits of planes as bits of doubles.
  const auto bit = [](unsigned plane) { return hn::BitCast(df, hn::Set(dul, std::uint64_t{1} << plane)); };
  const auto outside = [&](MaskVector inside, unsigned plane) {
    return hn::IfThenZeroElse(inside, bit(plane));
  };
  Vector any = hn::Zero(df);
  for (std::size_t i = 0; i < n; i += k_step) {
    const Three p = load(points, i);
    const Three q{hn::Add(combine(p, row0.x, row1.x, row2.x), row3.x),
                  hn::Add(combine(p, row0.y, row1.y, row2.y), row3.y),
                  hn::Add(combine(p, row0.z, row1.z, row2.z), row3.z)};
    store(q, points, i);
    const Vector limit_x = hn::Mul(q.z, tan_x), limit_y = hn::Mul(q.z, tan_y);
    Vector code = hn::Or(outside(hn::Ge(q.z, hither), 0), outside(hn::Le(q.z, yon), 1));
    code = hn::Or(code, outside(hn::Ge(q.x, hn::Neg(limit_x)), 2));
    code = hn::Or(code, outside(hn::Le(q.x, limit_x), 3));
    code = hn::Or(code, outside(hn::Ge(q.y, hn::Neg(limit_y)), 4));
    code = hn::Or(code, outside(hn::Le(q.y, limit_y), 5));
    any = hn::Or(any, code);
    hn::Store(hn::TruncateTo(dw, hn::BitCast(dul, code)), dw, codes + i);
  }
  alignas(k_alignment) std::uint64_t lanes[k_step];
  hn::Store(hn::BitCast(dul, any), dul, lanes);
  std::uint64_t bits = 0;
  for (const std::uint64_t lane : lanes) bits |= lane;
  return static_cast<std::uint32_t>(bits);
}

bool transform_directions_here(const M44d& m, std::size_t n, PointArrays directions) {
  const Three row0{set(m[0][0]), set(m[0][1]), set(m[0][2])};
  const Three row1{set(m[1][0]), set(m[1][1]), set(m[1][2])};
  const Three row2{set(m[2][0]), set(m[2][1]), set(m[2][2])};
  bool any_zero = false;
  for (std::size_t i = 0; i < n; i += k_step) {
    const Three d = load(directions, i);
    const Three unit = normalized({combine(d, row0.x, row1.x, row2.x), combine(d, row0.y, row1.y, row2.y),
                                   combine(d, row0.z, row1.z, row2.z)});
    store(unit, directions, i);
    const MaskVector zero = hn::And(hn::Eq(unit.x, hn::Zero(df)),
                                    hn::And(hn::Eq(unit.y, hn::Zero(df)), hn::Eq(unit.z, hn::Zero(df))));
    if (HWY_UNLIKELY(!hn::AllFalse(df, zero))) {
      const std::uint32_t counted = n - i < k_step ? (1u << (n - i)) - 1 : ~0u;
      any_zero = any_zero || (bits_of(zero) & counted) != 0;
    }
  }
  return any_zero;
}

/// Rounded by floor(v + 0.5), then limited; what is no number becomes `low`.
HWY_INLINE Vector place(Vector v, Vector low, Vector high) {
  const Vector rounded = hn::Floor(hn::Add(v, set(0.5)));
  return hn::IfThenElse(hn::Gt(rounded, low), smaller(rounded, high), low);
}

void project_here(const DeviceMapping::Terms& t, std::size_t n, PointArrays points, std::int32_t* x,
                  std::int32_t* y, std::int32_t* z) {
  const Vector low_x = set(t.low_x), high_x = set(t.high_x), low_y = set(t.low_y), high_y = set(t.high_y);
  const IntVector turned = hn::Set(di, static_cast<std::int32_t>(t.low_y + t.high_y));
  for (std::size_t i = 0; i < n; i += k_step) {
    const Three p = load(points, i);
    const Vector inverse = hn::Div(set(1), p.z);
    const auto axis = [&](Vector v, double scale, double offset) {
      return hn::Add(set(offset), hn::Mul(set(scale), hn::Mul(v, inverse)));
    };
    const Vector px = place(axis(p.x, t.scale_x, t.offset_x), low_x, high_x);
    const Vector py = place(axis(p.y, t.scale_y, t.offset_y), low_y, high_y);
    const Vector depth = hn::Mul(
        hn::Mul(set(t.depth_scale), hn::Sub(set(1), hn::Mul(set(t.nearest), inverse))), set(t.depth_max));
    const IntVector row = hn::DemoteTo(di, py);
    hn::Store(hn::DemoteTo(di, px), di, x + i);
    hn::Store(t.y_down ? hn::Sub(turned, row) : row, di, y + i);
    hn::Store(hn::DemoteTo(di, place(depth, hn::Zero(df), set(t.depth_max))), di, z + i);
  }
}

// ----------------------------------------------------------------------------------------------- lighting

/// The first power of two terms of a series in w, `first` and every second one after it.
template <std::size_t first, std::size_t last, std::size_t size>
HWY_INLINE Vector series(const std::array<double, size>& terms, Vector w) {
  Vector sum = set(terms[last]);
  for (std::size_t k = last; k > first; k -= 2) sum = hn::Add(set(terms[k - 2]), hn::Mul(w, sum));
  return sum;
}

/// highlight_power(x, n), n > 0: see there.
HWY_INLINE Vector power_of(Vector x, Vector n) {
  using namespace power;
  const MaskVector there = hn::Ge(x, set(k_smallest));
  const LongVector bits = hn::Add(hn::BitCast(dul, x), hn::Set(dul, k_one - k_root_half));
  const Vector m =
      hn::BitCast(df, hn::Add(hn::And(bits, hn::Set(dul, k_mantissa)), hn::Set(dul, k_root_half)));
  const Vector two_52 = hn::BitCast(df, hn::Set(dul, k_two_52));
  const Vector k = hn::Sub(hn::BitCast(df, hn::Or(hn::ShiftRight<52>(bits), hn::Set(dul, k_two_52))),
                           hn::Add(two_52, set(1023)));
  const Vector s = hn::Div(hn::Sub(m, set(1)), hn::Add(m, set(1)));
  const Vector z = hn::Mul(s, s), zz = hn::Mul(z, z);
  const Vector log_of_m = hn::Mul(s, hn::Add(series<0, 8>(k_log, zz), hn::Mul(z, series<1, 9>(k_log, zz))));
  const Vector t = hn::Mul(n, hn::Add(k, log_of_m));
  const MaskVector seen = hn::And(there, hn::Ge(t, set(k_least)));
  const Vector limited = hn::IfThenElse(hn::Lt(t, set(k_most)), t, set(k_most));
  const Vector shifted = hn::Add(limited, set(k_round));
  const Vector f = hn::Sub(limited, hn::Sub(shifted, set(k_round)));
  const Vector ff = hn::Mul(f, f);
  const Vector fraction = hn::Add(series<0, 12>(k_exp, ff), hn::Mul(f, series<1, 13>(k_exp, ff)));
  const LongVector exponent =
      hn::ShiftLeft<52>(hn::Add(hn::BitCast(dul, shifted), hn::Set(dul, std::uint64_t{1023})));
  return hn::IfThenElseZero(seen, hn::Mul(fraction, hn::BitCast(df, exponent)));
}

struct Channels {
  Vector r, g, b;
};

/// sum + color * v where `lit`.
HWY_INLINE void add(Channels& sum, MaskVector lit, const Channels& color, Vector v) {
  sum.r = hn::IfThenElse(lit, hn::Add(sum.r, hn::Mul(color.r, v)), sum.r);
  sum.g = hn::IfThenElse(lit, hn::Add(sum.g, hn::Mul(color.g, v)), sum.g);
  sum.b = hn::IfThenElse(lit, hn::Add(sum.b, hn::Mul(color.b, v)), sum.b);
}

/// clamp01(), then DeviceMapping's rounding.
HWY_INLINE IntVector device_color(Vector v, Vector color_max) {
  const Vector limited = hn::IfThenElseZero(hn::Gt(v, hn::Zero(df)), smaller(v, set(1)));
  return hn::DemoteTo(di, place(hn::Mul(limited, color_max), hn::Zero(df), color_max));
}

template <bool highlights>
HWY_INLINE void light_here_with(const Reflection& model, std::size_t n, PointArrays points,
                                PointArrays normals, std::uint32_t* red_green, std::uint32_t* blue) {
  const Vector color_max = set(model.color_max);
  const Vector kd = set(model.kd), ks = set(model.ks), shine = set(model.shine);
  const Vector zero = hn::Zero(df);
  for (std::size_t i = 0; i < n; i += k_step) {
    const Three point = load(points, i), normal = load(normals, i);
    Channels sum{set(model.ambient.r), set(model.ambient.g), set(model.ambient.b)};
    Three to_eye = point;
    if constexpr (highlights) to_eye = normalized(Three{zero, zero, zero} - point);
    for (const LightRow& row : model.lights) {
      Three to_light = all(row.position);
      Channels arriving{set(row.color.r), set(row.color.g), set(row.color.b)};
      Channels tint{set(row.tint.r), set(row.tint.g), set(row.tint.b)};
      MaskVector reached = hn::FirstN(df, k_step);
      if (row.kind == LightRow::Kind::point) {
        to_light = normalized(to_light - point);
      } else if (row.kind == LightRow::Kind::prepared) {
        const LightRow::Prepared& p = row.prepared;
        to_light = {hn::Load(df, p.to_x + i), hn::Load(df, p.to_y + i), hn::Load(df, p.to_z + i)};
        const Vector fraction = hn::Load(df, p.fraction + i);
        reached = hn::Gt(fraction, zero);
        arriving = {hn::Mul(arriving.r, fraction), hn::Mul(arriving.g, fraction),
                    hn::Mul(arriving.b, fraction)};
        tint = {hn::Mul(arriving.r, set(model.color.r)), hn::Mul(arriving.g, set(model.color.g)),
                hn::Mul(arriving.b, set(model.color.b))};
      }
      const Vector n_dot_l = dot(normal, to_light);
      const MaskVector lit = hn::And(reached, hn::Gt(n_dot_l, zero));
      if (hn::AllFalse(df, lit)) continue;
      add(sum, lit, tint, hn::Mul(kd, n_dot_l));
      if constexpr (highlights) {
        const Vector twice = hn::Mul(set(2), n_dot_l);
        const Three mirrored{hn::Sub(hn::Mul(twice, normal.x), to_light.x),
                             hn::Sub(hn::Mul(twice, normal.y), to_light.y),
                             hn::Sub(hn::Mul(twice, normal.z), to_light.z)};
        const Vector r_dot_v = larger(zero, dot(mirrored, to_eye));
        if (model.shine == 0) {
          add(sum, lit, arriving, ks);
        } else if (!hn::AllFalse(df, hn::And(lit, hn::Gt(r_dot_v, zero)))) {  // else all powers are 0
          add(sum, lit, arriving, hn::Mul(ks, power_of(r_dot_v, shine)));
        }
      }
    }
    const IntVector r = device_color(sum.r, color_max), g = device_color(sum.g, color_max);
    hn::Store(hn::BitCast(dw, hn::Or(r, hn::ShiftLeft<16>(g))), dw, red_green + i);
    hn::Store(hn::BitCast(dw, device_color(sum.b, color_max)), dw, blue + i);
  }
}

void light_here(const Reflection& model, std::size_t n, PointArrays points, PointArrays normals,
                std::uint32_t* red_green, std::uint32_t* blue) {
  if (model.ks != 0) {
    light_here_with<true>(model, n, points, normals, red_green, blue);
  } else {
    light_here_with<false>(model, n, points, normals, red_green, blue);
  }
}

void depth_range_here(std::span<const V3d> points, double cx, double cy, double cz, double c, double& nearest,
                      double& farthest) {
  const Vector ax = set(cx), ay = set(cy), az = set(cz), shift = set(c);
  Vector low = set(nearest), high = set(farthest);
  std::size_t i = 0;
  const double* values = points.empty() ? nullptr : &points.front().x;
  for (; i + k_step <= points.size(); i += k_step) {
    Three p;
    hn::LoadInterleaved3(df, values + 3 * i, p.x, p.y, p.z);
    const Vector depth = hn::Add(combine(p, ax, ay, az), shift);
    low = smaller(low, depth);
    high = larger(high, depth);
  }
  alignas(k_alignment) double lows[k_step], highs[k_step];
  hn::Store(low, df, lows);
  hn::Store(high, df, highs);
  for (std::size_t k = 0; k < k_step; ++k) {
    nearest = lows[k] < nearest ? lows[k] : nearest;
    farthest = farthest < highs[k] ? highs[k] : farthest;
  }
  for (; i < points.size(); ++i) {
    const V3d& p = points[i];
    const double depth = p.x * cx + p.y * cy + p.z * cz + c;
    nearest = depth < nearest ? depth : nearest;
    farthest = farthest < depth ? depth : farthest;
  }
}

}  // namespace
}  // namespace farop::batched::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace farop::batched {

HWY_EXPORT(find_planes_here);
HWY_EXPORT(transform_points_here);
HWY_EXPORT(transform_directions_here);
HWY_EXPORT(project_here);
HWY_EXPORT(light_here);
HWY_EXPORT(depth_range_here);

void find_planes(std::span<PlaneGroup> groups, const Row* rows, const V3d& eye) {
  HWY_DYNAMIC_DISPATCH(find_planes_here)(groups, rows, eye);
}

std::uint32_t transform_points(const M44d& m, const Frustum& frustum, std::size_t n, PointArrays points,
                               std::uint32_t* codes) {
  return HWY_DYNAMIC_DISPATCH(transform_points_here)(m, frustum, n, points, codes);
}

bool transform_directions(const M44d& m, std::size_t n, PointArrays directions) {
  return HWY_DYNAMIC_DISPATCH(transform_directions_here)(m, n, directions);
}

void project(const DeviceMapping::Terms& mapping, std::size_t n, PointArrays points, std::int32_t* x,
             std::int32_t* y, std::int32_t* z) {
  HWY_DYNAMIC_DISPATCH(project_here)(mapping, n, points, x, y, z);
}

void light(const Reflection& reflection, std::size_t n, PointArrays points, PointArrays normals,
           std::uint32_t* red_green, std::uint32_t* blue) {
  HWY_DYNAMIC_DISPATCH(light_here)(reflection, n, points, normals, red_green, blue);
}

void depth_range(std::span<const V3d> points, double cx, double cy, double cz, double c, double& nearest,
                 double& farthest) {
  HWY_DYNAMIC_DISPATCH(depth_range_here)(points, cx, cy, cz, c, nearest, farthest);
}

}  // namespace farop::batched
#endif
