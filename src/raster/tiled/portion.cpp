// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/tiled/portion.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "raster/corner_color.h"
#include "raster/wide_integer.h"
#include "shading/material.h"

namespace farop::tiled {
namespace {

/// Tiles in a row from which on it pays to look which of them a triangle covers.
constexpr int k_long_triangle = 4;

template <class T>
std::span<const T> part(const std::vector<T>& all, std::size_t first, std::size_t count) {
  return std::span(all).subspan(first, count);
}

template <class T>
std::size_t bytes_of(const std::vector<T>& v) {
  return v.size() * sizeof(T);
}

/// The largest value that the edge from a to b has at the samples of a tile; negative: none is on its left.
std::int64_t best_of(const ScreenVertex& a, const ScreenVertex& b, std::int64_t low_x, std::int64_t high_x,
                     std::int64_t low_y, std::int64_t high_y) {
  const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
  const std::int64_t x = dy > 0 ? low_x : high_x, y = dx > 0 ? high_y : low_y;
  return dx * (y - a.y) - dy * (x - a.x);
}

}  // namespace

FillPolygon KeptPolygons::operator[](std::uint32_t number) const {
  const KeptPolygon& p = polygons[number];
  FillPolygon polygon{part(corners, p.first, p.count), {}, {}, {}, {}, p.look};
  if (!normals.empty()) {
    polygon.normals = part(normals, p.first, p.count);
    polygon.eye_positions = part(eye_positions, p.first, p.count);
  }
  if (p.first_texture != k_no_vertex_id) polygon.textures = part(textures, p.first_texture, p.count);
  if (p.first_opacity != k_no_vertex_id) polygon.opacities = part(opacities, p.first_opacity, p.count);
  return polygon;
}

std::size_t KeptPolygons::bytes() const {
  return bytes_of(polygons) + bytes_of(corners) + bytes_of(normals) + bytes_of(eye_positions) +
         bytes_of(textures) + bytes_of(opacities);
}

void KeptPolygons::clear() {
  polygons.clear(), corners.clear();
  normals.clear(), eye_positions.clear(), textures.clear(), opacities.clear();
}

void Portion::start(const TileGrid& grid, DrawMode mode, int color_resolution, std::uint32_t number) {
  number_ = number;
  grid_ = &grid;
  mode_ = mode;
  color_resolution_ = color_resolution;
  pool_.take_all_back();
  bins_.assign(static_cast<std::size_t>(grid.count()), {});
  kept_.clear();
  kept_bytes_ = 0;
  spans_.clear();
  span_sorter_.start(grid);
  has_shaders_ = false;
  last_look_ = {}, last_opaque_ = true, last_invisible_ = false;
}

Progress Portion::add(const ScreenPolygonBatch& batch, std::uint32_t number, Progress first, std::size_t end,
                      const PortionLimits& limits) {
  batch_ = number;
  limits_ = limits;
  for (; first.polygon < end; ++first.polygon) {
    if (bytes() > limits.all) return first;
    const ScreenPolygonRecord& record = batch.polygons[first.polygon];
    if (first.row == 0 && add_simple_triangle(batch, record)) continue;
    first.row = add_polygon(batch, record, first.row);
    if (first.row != 0) return first;
  }
  return first;
}

inline void Portion::add_entry(Bin& bin, const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c,
                               const TrianglePayload& payload) {
  TriangleEntry& e = bin.add(pool_);
  e.x[0] = a.x, e.x[1] = b.x, e.x[2] = c.x;
  e.y[0] = a.y, e.y[1] = b.y, e.y[2] = c.y;
  e.z[0] = a.z, e.z[1] = b.z, e.z[2] = c.z;
  e.color[0] = payload.color[0], e.color[1] = payload.color[1], e.color[2] = payload.color[2];
  e.source = payload.source, e.batch = batch_;
  e.portion = static_cast<std::uint16_t>(number_), e.transparent = payload.transparent;
}

// The triangle that most are; false, and nothing happens, for all others.
bool Portion::add_simple_triangle(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record) {
  if (record.vertex_count != 3 || mode_ == DrawMode::phong || color_resolution_ != 256) return false;
  if (record.material != last_look_.material || record.shader != last_look_.shader) return false;
  if (!last_opaque_) return false;
  const ScreenVertex* const v = batch.vertices.data() + record.first_vertex;
  if ((v[0].r | v[0].g | v[0].b | v[1].r | v[1].g | v[1].b | v[2].r | v[2].g | v[2].b) > 255) return false;
  constexpr std::int32_t k_limit = 1 << k_plane_coordinate_bits;
  const auto is_small = [](const ScreenVertex& c) {
    return static_cast<std::uint32_t>(c.x + k_limit) < 2u * k_limit &&
           static_cast<std::uint32_t>(c.y + k_limit) < 2u * k_limit;
  };
  if (!is_small(v[0]) || !is_small(v[1]) || !is_small(v[2])) return false;
  std::int64_t area = doubled_area(v[0], v[1], v[2]);
  if (area == 0) return true;  // covers nothing
  // Turns corners until the lowest, then leftmost comes first; then the others counter-clockwise.
  const auto key = [](const ScreenVertex& c) { return (std::int64_t{c.y} << 32) + c.x; };
  const std::int64_t k0 = key(v[0]), k1 = key(v[1]), k2 = key(v[2]);
  // Without branches, which would be guessed wrong every other time.
  unsigned a = static_cast<unsigned>(k1 < k0);
  a = k2 < std::min(k0, k1) ? 2 : a;
  static constexpr unsigned k_next[] = {1, 2, 0, 1};
  const auto clockwise = static_cast<unsigned>(area < 0);
  const unsigned b = k_next[a + clockwise], c = k_next[a + 1 - clockwise];
  area = area < 0 ? -area : area;
  const std::int32_t low_x = std::min(std::min(v[0].x, v[1].x), v[2].x);
  const std::int32_t high_x = std::max(std::max(v[0].x, v[1].x), v[2].x);
  const std::int32_t low_y = v[a].y, high_y = std::max(v[b].y, v[c].y);
  const int bits = grid_->subpixel_bits, up = (1 << bits) - 1;
  const Samples samples = {std::max((low_x + up) >> bits, 0), std::min((high_x + up) >> bits, grid_->width),
                           std::max((low_y + up) >> bits, 0), std::min((high_y + up) >> bits, grid_->height)};
  if (samples.empty()) return true;
  if (!is_surely_plane_triangle(v[0].z, v[1].z, v[2].z, std::max(high_x - low_x, high_y - low_y), area,
                                bits)) {
    return false;
  }
  const auto word = [](const ScreenVertex& k) {
    return std::uint32_t{k.r} | std::uint32_t{k.g} << 8 | std::uint32_t{k.b} << 16;
  };
  TrianglePayload payload{{word(v[a]), word(v[b]), word(v[c])}, 0};
  if (mode_ == DrawMode::flat) payload.color[0] = payload.color[1] = payload.color[2] = word(v[0]);
  const std::int32_t* const tile_of = grid_->tile_of.data();
  const int x = tile_of[samples.first_column], y = tile_of[samples.first_row];
  if (x == tile_of[samples.end_column - 1] && y == tile_of[samples.end_row - 1]) {
    add_entry(bins_[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_->columns) +
                    static_cast<std::size_t>(x)],
              v[a], v[b], v[c], payload);
  } else {
    add_to_tiles({v[a], v[b], v[c]}, payload, samples);
  }
  return true;
}

// Returns the row to go on with, 0: all was taken.
int Portion::add_polygon(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record, int first_row) {
  const SurfaceLook look{record.material, record.shader};
  if (look != last_look_) {
    last_look_ = look;
    last_opaque_ = look.is_opaque(), last_invisible_ = look.is_invisible();
    has_shaders_ = has_shaders_ || look.shader != nullptr;
  }
  if (last_invisible_ || record.vertex_count == 0) return 0;
  const std::span<const ScreenVertex> corners = batch.corners(record);
  const bool on_planes = last_opaque_ || mode_ != DrawMode::phong;
  const std::optional<std::uint32_t> center =
      on_planes ? fan_center(corners) : std::optional<std::uint32_t>();
  if (!center) {
    return add_by_scan_lines(batch, record, all_corners(corners.size()), first_row, limits_.all);
  }
  TrianglePayload payload;
  payload.transparent = last_opaque_ ? 0 : 1;
  std::uint32_t first_kept = 0;
  if (mode_ == DrawMode::phong) {
    payload.source = keep(batch, record, all_corners(corners.size()));
    first_kept = kept_.polygons.back().first;
  } else if (mode_ == DrawMode::flat) {
    payload.color[0] = payload.color[1] = payload.color[2] = color_word(corners.front());
  }
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) {
    const auto numbers = fan_triangle(corners, *center, i);
    if (!numbers) continue;
    const std::uint32_t of_triangle[3] = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
    const Triangle t{corners[of_triangle[0]], corners[of_triangle[1]], corners[of_triangle[2]]};
    for (std::size_t k = 0; k < 3; ++k) {
      if (mode_ == DrawMode::phong) {
        payload.color[k] = first_kept + of_triangle[k];
      } else if (mode_ == DrawMode::gouraud) {
        payload.color[k] = color_word(corners[of_triangle[k]]);
      }
    }
    add_triangle(batch, record, t, payload, of_triangle);
  }
  return 0;
}

std::span<const std::uint32_t> Portion::all_corners(std::size_t count) {
  if (all_corners_.size() < count) {
    all_corners_.resize(count);
    std::iota(all_corners_.begin(), all_corners_.end(), 0u);
  }
  return part(all_corners_, 0, count);
}

std::uint32_t Portion::color_word(const ScreenVertex& v) const {
  return to_8_bits(v.r, color_resolution_) | std::uint32_t{to_8_bits(v.g, color_resolution_)} << 8 |
         std::uint32_t{to_8_bits(v.b, color_resolution_)} << 16;
}

inline Portion::Samples Portion::samples_of(std::int32_t low_x, std::int32_t high_x, std::int32_t low_y,
                                            std::int32_t high_y) const {
  const int bits = grid_->subpixel_bits;
  const auto sample = [bits](std::int32_t v, int size) {
    const std::int64_t at_or_after = -(-std::int64_t{v} >> bits);
    return static_cast<int>(std::min<std::int64_t>(std::max<std::int64_t>(at_or_after, 0), size));
  };
  return {sample(low_x, grid_->width), sample(high_x, grid_->width), sample(low_y, grid_->height),
          sample(high_y, grid_->height)};
}

template <class Add>
void Portion::for_each_tile(const Samples& samples, const Add& add) {
  const std::vector<std::int32_t>& tile_of = grid_->tile_of;
  const auto of = [&](int sample) { return tile_of[static_cast<std::size_t>(sample)]; };
  const int first_x = of(samples.first_column), last_x = of(samples.end_column - 1);
  const int first_y = of(samples.first_row), last_y = of(samples.end_row - 1);
  for (int y = first_y; y <= last_y; ++y) {
    for (int x = first_x; x <= last_x; ++x) {
      add(bins_[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_->columns) +
                static_cast<std::size_t>(x)],
          x, y, first_x == last_x || first_y == last_y);
    }
  }
}

inline Portion::Samples Portion::samples_of(const Triangle& t) const {
  return samples_of(std::min({t.a.x, t.b.x, t.c.x}), std::max({t.a.x, t.b.x, t.c.x}), t.a.y,
                    std::max(t.b.y, t.c.y));
}

void Portion::add_triangle(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record,
                           const Triangle& t, TrianglePayload payload, const std::uint32_t (&numbers)[3]) {
  const Samples samples = samples_of(t);
  if (samples.empty()) return;
  if (!is_plane_triangle(t, grid_->subpixel_bits)) {
    add_by_scan_lines(batch, record, numbers, 0, std::numeric_limits<std::size_t>::max());
    return;
  }
  if (payload.transparent != 0) payload.source = keep(batch, record, numbers);
  add_to_tiles(t, payload, samples);
}

void Portion::add_to_tiles(const Triangle& t, const TrianglePayload& payload, const Samples& samples) {
  const int side = grid_->side, bits = grid_->subpixel_bits;
  // Long and thin ones cover samples in few of the tiles that they cross.
  const int columns = (samples.end_column - samples.first_column) / side;
  if (columns > k_long_triangle && 4 * columns > std::min(samples.end_row - samples.first_row, side)) {
    add_to_tiles_of_rows(t, payload, samples);
    return;
  }
  for_each_tile(samples, [&](Bin& bin, int x, int y, bool in_line) {
    if (!in_line) {
      const std::int64_t low_x = (std::int64_t{x} * side) << bits, low_y = (std::int64_t{y} * side) << bits;
      const std::int64_t reach = std::int64_t{side - 1} << bits;
      const auto misses = [&](const ScreenVertex& a, const ScreenVertex& b) {
        return best_of(a, b, low_x, low_x + reach, low_y, low_y + reach) < 0;
      };
      if (misses(t.a, t.b) || misses(t.b, t.c) || misses(t.c, t.a)) return;
    }
    add_entry(bin, t.a, t.b, t.c, payload);
    bin.has_transparent = bin.has_transparent || payload.transparent != 0;
  });
}

// Row by row, into the tiles with samples that it covers.
void Portion::add_to_tiles_of_rows(const Triangle& t, const TrianglePayload& payload,
                                   const Samples& samples) {
  const int bits = grid_->subpixel_bits;
  const auto row_at_or_above = [bits](const ScreenVertex& v) { return -(-v.y >> bits); };
  const int row_of_b = row_at_or_above(t.b), row_of_c = row_at_or_above(t.c);
  const auto crossing = [&](const ScreenVertex& low, const ScreenVertex& high, int row) {
    const std::int64_t dx = std::int64_t{high.x} - low.x, dy = std::int64_t{high.y} - low.y;
    const std::int64_t up = (std::int64_t{row} << bits) - low.y;
    const std::int64_t column = -floor_div<std::int64_t>(-(low.x * dy + up * dx), dy << bits);
    return static_cast<int>(std::clamp<std::int64_t>(column, samples.first_column, samples.end_column));
  };
  last_row_.resize(static_cast<std::size_t>(grid_->columns));
  int tile_row = -1;
  for (int row = samples.first_row; row < samples.end_row; ++row) {
    const int first = row < row_of_c ? crossing(t.a, t.c, row) : crossing(t.c, t.b, row);
    const int end = row < row_of_b ? crossing(t.a, t.b, row) : crossing(t.b, t.c, row);
    if (first >= end) continue;
    if (grid_->tile_of[static_cast<std::size_t>(row)] != tile_row) {
      tile_row = grid_->tile_of[static_cast<std::size_t>(row)];
      ++tile_rows_;
    }
    const int last = grid_->tile_of[static_cast<std::size_t>(end - 1)];
    for (int x = grid_->tile_of[static_cast<std::size_t>(first)]; x <= last; ++x) {
      if (std::exchange(last_row_[static_cast<std::size_t>(x)], tile_rows_) == tile_rows_) continue;
      Bin& bin = bins_[static_cast<std::size_t>(tile_row) * static_cast<std::size_t>(grid_->columns) +
                       static_cast<std::size_t>(x)];
      add_entry(bin, t.a, t.b, t.c, payload);
      bin.has_transparent = bin.has_transparent || payload.transparent != 0;
    }
  }
}

// Returns the row to go on with when more than `byte_limit` bytes are in use, else 0.
int Portion::add_by_scan_lines(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record,
                               std::span<const std::uint32_t> numbers, int first_row,
                               std::size_t byte_limit) {
  const std::span<const ScreenVertex> corners = batch.corners(record);
  std::int32_t low_x = corners[numbers[0]].x, high_x = low_x, low_y = corners[numbers[0]].y, high_y = low_y;
  for (const std::uint32_t i : numbers) {
    low_x = std::min(low_x, corners[i].x), high_x = std::max(high_x, corners[i].x);
    low_y = std::min(low_y, corners[i].y), high_y = std::max(high_y, corners[i].y);
  }
  const Samples samples = samples_of(low_x, high_x, low_y, high_y);
  if (samples.empty()) return 0;
  if (mode_ == DrawMode::phong) {
    add_special(batch, record, numbers, samples);
    return 0;
  }
  load_corners(batch, record, numbers);
  if (bytes() + span_sorter_.most_bytes(corners_) > limits_.spans) {
    add_special(batch, record, numbers, samples);
    return 0;
  }
  const auto nearer = [](const ScreenVertex& a, const ScreenVertex& b) { return a.z < b.z; };
  const std::int32_t nearest = std::min_element(corners_.begin(), corners_.end(), nearer)->z;
  const std::size_t others = bytes() - spans_.bytes();
  const std::size_t room = byte_limit - std::min(others, byte_limit);
  return span_sorter_.sort(corners_, opacities_, first_row, room, spans_,
                           [&](int tile, std::uint32_t first, std::uint32_t count) {
                             TriangleEntry& e = add_other(bins_[static_cast<std::size_t>(tile)], k_spans);
                             e.x[0] = static_cast<std::int32_t>(first);
                             e.x[1] = static_cast<std::int32_t>(count);
                             e.z[1] = nearest;
                           });
}

// An entry that is no triangle, of the surface that polygons are taken from.
TriangleEntry& Portion::add_other(Bin& bin, std::int32_t kind) {
  TriangleEntry& e = bin.add(pool_);
  e = {};
  e.z[0] = kind;
  e.batch = batch_, e.portion = static_cast<std::uint16_t>(number_);
  e.transparent = last_opaque_ ? 0 : 1;
  bin.has_transparent = bin.has_transparent || !last_opaque_;
  return e;
}

// What PolygonFiller interpolates of a polygon by scan lines.
void Portion::load_corners(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record,
                           std::span<const std::uint32_t> numbers) {
  const std::span<const ScreenVertex> corners = batch.corners(record);
  corners_.clear(), opacities_.clear();
  for (const std::uint32_t i : numbers) {
    ScreenVertex v = corners[i];
    const ScreenVertex& color = corners[mode_ == DrawMode::flat ? 0 : i];
    v.r = to_8_bits(color.r, color_resolution_), v.g = to_8_bits(color.g, color_resolution_);
    v.b = to_8_bits(color.b, color_resolution_);
    corners_.push_back(v);
    if (last_opaque_) continue;
    opacities_.push_back(batch.opacities.empty() ? to_vector(record.material->opacity())
                                                 : V3d(batch.opacities[record.first_vertex + i]));
  }
}

void Portion::add_special(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record,
                          std::span<const std::uint32_t> numbers, const Samples& samples) {
  const std::uint32_t number = keep(batch, record, numbers);
  for_each_tile(samples, [&](Bin& bin, int, int, bool) { add_other(bin, k_special).source = number; });
}

std::uint32_t Portion::keep(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record,
                            std::span<const std::uint32_t> numbers) {
  KeptPolygon polygon;
  polygon.first = static_cast<std::uint32_t>(kept_.corners.size());
  polygon.count = static_cast<std::uint32_t>(numbers.size());
  polygon.look = {record.material, record.shader};
  const std::span<const ScreenVertex> corners = batch.corners(record);
  for (const std::uint32_t i : numbers) {
    ScreenVertex v = corners[i];
    if (mode_ == DrawMode::flat) v.r = corners[0].r, v.g = corners[0].g, v.b = corners[0].b;
    kept_.corners.push_back(v);
  }
  const auto copy = [&](const std::vector<V3f>& from, std::vector<V3f>& to) {
    const auto first = static_cast<std::uint32_t>(to.size());
    for (const std::uint32_t i : numbers) to.push_back(from[record.first_vertex + i]);
    return first;
  };
  if (mode_ == DrawMode::phong) {
    copy(batch.normals, kept_.normals);
    copy(batch.eye_positions, kept_.eye_positions);
    if (!batch.textures.empty()) polygon.first_texture = copy(batch.textures, kept_.textures);
  }
  if (!batch.opacities.empty()) polygon.first_opacity = copy(batch.opacities, kept_.opacities);
  kept_.polygons.push_back(polygon);
  kept_bytes_ = kept_.bytes();
  return static_cast<std::uint32_t>(kept_.polygons.size() - 1);
}

}  // namespace farop::tiled
