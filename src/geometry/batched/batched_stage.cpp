// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/batched/batched_stage.h"

#include <algorithm>

namespace farop::batched {
namespace {

/// A chunk is full when its polygons have so many corners: its arrays then stay in the L2 cache.
constexpr std::size_t k_full_corners = 1024;
/// Polygons of more corners go to PlainStage.
constexpr std::size_t k_long_polygon = PlaneGroup::k_longest;
constexpr std::size_t k_max_corners = k_full_corners + k_long_polygon;
constexpr std::size_t k_max_polygons = k_max_corners / 3;
/// Every corner may need its vertex with the normal as it is and turned round.
constexpr std::size_t k_max_items = 2 * k_max_corners + k_lanes;
/// Slots for the vertices met in a chunk, by the low bits of their number.
constexpr std::size_t k_slots = 4096;
constexpr std::uint32_t k_none = 0xFFFFFFFFu;

template <std::size_t size>
struct alignas(k_alignment) Points {
  double x[size], y[size], z[size];

  PointArrays arrays() { return {x, y, z}; }
  V3d at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const V3d& p) { x[i] = p.x, y[i] = p.y, z[i] = p.z; }
};

template <std::size_t size>
struct alignas(k_alignment) Colors {
  std::uint32_t red_green[size], blue[size];
};

bool is_affine(const M44d& m) {
  return m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
}

}  // namespace

// An item is a vertex with one normal; every corner that shows it takes what was computed for it.
struct BatchedStage::Arrays {
  // By item.
  Points<k_max_items> positions;  ///< local, then eye space
  Points<k_max_items> normals;    ///< eye space, turned to the lit side
  Colors<k_max_items> colors;
  alignas(k_alignment) std::int32_t x[k_max_items], y[k_max_items], z[k_max_items];  ///< device
  alignas(k_alignment) std::uint32_t codes[k_max_items];  ///< planes that it lies outside of
  std::uint32_t vertex[k_max_items];                      ///< in the surface
  std::uint32_t other[k_max_items];  ///< while sorting out: the item's new number, or its twin
  V3f opacities[k_max_items];
  // By corner.
  std::uint32_t item[k_max_corners];
  // By polygon, by survivor.
  Corners polygons[k_max_polygons];
  Survivor survivors[k_max_polygons + 1];
  Points<k_max_polygons + k_lanes> planes;  ///< unit normals, eye space
  // Flat shading's one corner.
  Points<k_max_polygons + k_lanes> flat_positions, flat_normals;
  Colors<k_max_polygons + k_lanes> flat_colors;
  V3f flat_opacities[k_max_polygons];

  std::uint32_t slots[k_slots];
};

BatchedStage::BatchedStage(const GeometrySetup& setup, const GeometryOptions& options,
                           const PolygonWants& wants)
    : options_(options),
      wants_(wants),
      mapping_(setup.device_mapping()),
      frustum_(setup.frustum()),
      triangles_only_(options.triangles || wants.triangles),
      plain_(setup, options, wants),
      lighting_(setup.shading, mapping_),
      a_(std::make_unique<Arrays>()) {}

BatchedStage::~BatchedStage() = default;

std::span<const BatchedStage::Survivor> BatchedStage::survivors() const {
  return {a_->survivors, survivors_};
}

void BatchedStage::run(Piece& piece, std::size_t enough, ScreenPolygonBatch& batch, PolygonCounts& counts) {
  placed_ = piece.placed;
  const Surface& surface = placed_->surface;
  const bool one_by_one = placed_->flattened || !is_affine(placed_->local_to_eye) ||
                          (surface.shader && !surface.shader->is_pure());
  while (piece.polygons > 0 && batch.vertices.size() < enough) {
    const PolygonView first = *piece.first;
    if (one_by_one || first.corners.size() > k_long_polygon) {
      plain_.polygon(*placed_, first, batch, counts);
      ++piece.first, --piece.polygons;
    } else {
      take_chunk(piece);
      run_chunk(batch, counts);
    }
  }
}

/// Polygons that are not long and have their normals from where the first has them, until the chunk is full.
void BatchedStage::take_chunk(Piece& piece) {
  const Surface& surface = placed_->surface;
  const bool given = (*piece.first).has_given_normals;
  kind_ = given ? Normals::given : surface.averaged_normals.empty() ? Normals::of_plane : Normals::averaged;
  planes_.clear();
  PolygonList::Iterator at = piece.first;
  const std::uint64_t most = std::min<std::uint64_t>(piece.polygons, k_max_polygons);
  std::uint32_t polygons = 0;
  for (std::size_t corners = 0; polygons < most && corners < k_full_corners; ++polygons, ++at) {
    const PolygonView polygon = *at;
    const std::size_t size = polygon.corners.size();
    if (polygon.has_given_normals != given || size > k_long_polygon) break;
    a_->polygons[polygons] = {polygon.corners.data(), static_cast<std::uint32_t>(size)};
    planes_.add(surface.positions, polygon.corners);
    corners += size;
  }
  polygons_ = polygons;
  piece.first = at;
  piece.polygons -= polygons;
}

void BatchedStage::run_chunk(ScreenPolygonBatch& batch, PolygonCounts& counts) {
  planes_.find(placed_->eye_local);
  cull(counts);
  if (survivors_ == 0) return;
  collect_items();
  // So that nothing that was there before lies outside.
  for (std::size_t i = items_; i % k_lanes != 0; ++i) a_->positions.set(i, a_->positions.at(0));
  const std::uint32_t codes =
      transform_points(placed_->local_to_eye, frustum_, items_, a_->positions.arrays(), a_->codes);
  if (codes != 0) drop_outside(counts);
  find_normals();
  project(mapping_.terms(), items_, a_->positions.arrays(), a_->x, a_->y, a_->z);
  light_items();
  append(batch, counts);
}

void BatchedStage::cull(PolygonCounts& counts) {
  counts.loaded += polygons_;
  std::uint32_t corner = 0, kept = 0;
  for (std::size_t p = 0; p < polygons_; ++p) {
    const PolygonPlanes::Side side = planes_.side(p);
    if (side.degenerate) {
      ++counts.degenerate;
      continue;
    }
    if (side.faces_away && !options_.two_sided) {
      ++counts.back_facing;
      continue;
    }
    a_->survivors[kept] = {a_->polygons[p], corner, kept, side.faces_away, false};
    a_->planes.set(kept, planes_.normal(p));
    corner += a_->polygons[p].count;
    ++kept;
  }
  survivors_ = kept;
  transform_directions(placed_->normal_to_eye, kept, a_->planes.arrays());
}

void BatchedStage::collect_items() {
  const V3d* positions = placed_->surface.positions.data();
  const bool mirrored = placed_->mirrored;
  const auto vertex_of = [mirrored](const Corners& corners, std::size_t i) {
    // The first stays the first; of a mirrored polygon the others come the other way round.
    return corners.vertices[mirrored && i > 0 ? corners.count - i : i];
  };
  std::uint32_t items = 0;
  if (kind_ == Normals::of_plane) {
    for (const Survivor& survivor : survivors()) {
      const V3d plane = a_->planes.at(survivor.plane);
      const V3d normal = survivor.faces_away ? -plane : plane;
      for (std::size_t i = 0; i < survivor.corners.count; ++i, ++items) {
        const std::uint32_t v = vertex_of(survivor.corners, i);
        a_->item[items] = items;
        a_->vertex[items] = v;
        a_->positions.set(items, positions[v]);
        a_->normals.set(items, normal);
      }
    }
    items_ = items;
    return;
  }
  std::uint32_t corner = 0;
  for (const Survivor& survivor : survivors()) {
    for (std::size_t i = 0; i < survivor.corners.count; ++i, ++corner) {
      const std::uint32_t v = vertex_of(survivor.corners, i);
      std::uint32_t& slot = a_->slots[v % k_slots];
      if (slot >= items || a_->vertex[slot] != v) {
        slot = items;
        a_->vertex[items] = v;
        a_->positions.set(items, positions[v]);
        ++items;
      }
      a_->item[corner] = slot;
    }
  }
  items_ = items;
}

// Polygons outside one plane are dropped, those that a plane cuts are left alone; items of neither are not
// worked on any further.
void BatchedStage::drop_outside(PolygonCounts& counts) {
  std::uint32_t kept = 0;
  for (const Survivor& survivor : survivors()) {
    std::uint32_t any = 0, all = ~0u;
    const std::uint32_t* item = a_->item + survivor.first_corner;
    for (std::size_t i = 0; i < survivor.corners.count; ++i) {
      const std::uint32_t code = a_->codes[item[i]];
      any |= code, all &= code;
    }
    if (all != 0) {
      ++counts.totally_clipped;
      continue;
    }
    a_->survivors[kept] = survivor;
    a_->survivors[kept++].cut = any != 0;
  }
  survivors_ = kept;

  const auto for_each_corner_inside = [&](const auto& visit) {
    for (const Survivor& survivor : survivors()) {
      if (survivor.cut) continue;
      std::uint32_t* item = a_->item + survivor.first_corner;
      for (std::size_t i = 0; i < survivor.corners.count; ++i) visit(item[i]);
    }
  };
  std::fill_n(a_->other, items_, k_none);
  for_each_corner_inside([&](std::uint32_t item) { a_->other[item] = 0; });
  std::uint32_t items = 0;
  for (std::size_t i = 0; i < items_; ++i) {
    if (a_->other[i] == k_none) continue;
    a_->positions.set(items, a_->positions.at(i));
    a_->normals.set(items, a_->normals.at(i));
    a_->vertex[items] = a_->vertex[i];
    a_->other[i] = items++;
  }
  for_each_corner_inside([&](std::uint32_t& item) { item = a_->other[item]; });
  items_ = items;
}

void BatchedStage::find_normals() {
  if (kind_ == Normals::of_plane) return;  // they came with the items
  const std::vector<V3d>& own = *placed_->vertex_normals(kind_ == Normals::given);
  for (std::size_t i = 0; i < items_; ++i) a_->normals.set(i, own[a_->vertex[i]]);
  const bool any_zero = transform_directions(placed_->vertex_normal_to_eye, items_, a_->normals.arrays());
  const bool towards_front = kind_ == Normals::given && placed_->surface.normal_rule == NormalRule::nff;
  if (any_zero || options_.two_sided || towards_front) turn_normals(towards_front);
}

// Corners whose normal is not that of their vertex get an item of their own, or the twin of their vertex's.
void BatchedStage::turn_normals(bool towards_front) {
  std::fill_n(a_->other, items_, k_none);
  for (const Survivor& survivor : survivors()) {
    if (survivor.cut) continue;
    const V3d plane = a_->planes.at(survivor.plane);
    for (std::size_t i = 0; i < survivor.corners.count; ++i) {
      std::uint32_t& item = a_->item[survivor.first_corner + i];
      const V3d normal = a_->normals.at(item);
      if (normal == V3d(0, 0, 0)) {
        item = copy_item(item, survivor.faces_away ? -plane : plane);
        continue;
      }
      const bool turned = towards_front && normal.dot(plane) < 0;
      if (turned == survivor.faces_away) continue;
      std::uint32_t& twin = a_->other[item];
      if (twin == k_none) twin = copy_item(item, -normal);
      item = twin;
    }
  }
}

std::uint32_t BatchedStage::copy_item(std::uint32_t item, const V3d& normal) {
  const auto copy = static_cast<std::uint32_t>(items_++);
  a_->positions.set(copy, a_->positions.at(item));
  a_->normals.set(copy, normal);
  a_->vertex[copy] = a_->vertex[item];
  return copy;
}

void BatchedStage::light_items() {
  const Surface& surface = placed_->surface;
  LitArrays lit{a_->positions.arrays(), a_->normals.arrays(), a_->colors.red_green, a_->colors.blue};
  std::size_t count = items_;
  V3f* opacities = a_->opacities;
  if (options_.flat) {
    lit = {a_->flat_positions.arrays(), a_->flat_normals.arrays(), a_->flat_colors.red_green,
           a_->flat_colors.blue};
    count = survivors_;
    opacities = a_->flat_opacities;
    for (std::size_t s = 0; s < count; ++s) {
      if (a_->survivors[s].cut) continue;
      const std::uint32_t item = a_->item[a_->survivors[s].first_corner];
      a_->flat_positions.set(s, a_->positions.at(item));
      a_->flat_normals.set(s, a_->normals.at(item));
    }
  }
  const auto as_float = [](const Rgb& c) {
    const Rgb o = clamp01(c);
    return V3f(V3d(o.r, o.g, o.b));
  };
  if (options_.unlit) {
    std::fill_n(lit.red_green, count, 0);
    std::fill_n(lit.blue, count, 0);
    if (wants_.opacities) std::fill_n(opacities, count, V3f(1, 1, 1));
  } else if (!surface.shader) {
    lighting_.by_material(surface.material, count, lit);
    if (wants_.opacities) std::fill_n(opacities, count, as_float(surface.material.opacity()));
  } else {
    const auto texture = [&](std::size_t i) {
      if (surface.textures.empty()) return V3d(0, 0, 0);
      return V3d(surface.textures[a_->vertex[options_.flat ? a_->item[a_->survivors[i].first_corner] : i]]);
    };
    lighting_.by_shader(*surface.shader, count, lit, texture,
                        [&](std::size_t i, const Rgb& o) { opacities[i] = as_float(o); });
  }
}

void BatchedStage::append(ScreenPolygonBatch& batch, PolygonCounts& counts) {
  const std::span<const Survivor> all = survivors();
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first;
    while (end < all.size() && !all[end].cut) ++end;
    append_inside(first, end, batch, counts);
    for (first = end; first < all.size() && all[first].cut; ++first) {
      --counts.loaded;  // PlainStage counts it again
      const Corners& corners = all[first].corners;
      plain_.polygon(*placed_, {{corners.vertices, corners.count}, kind_ == Normals::given}, batch, counts);
    }
  }
}

void BatchedStage::append_inside(std::size_t first, std::size_t end, ScreenPolygonBatch& batch,
                                 PolygonCounts& counts) {
  std::size_t total = 0;
  for (std::size_t s = first; s < end; ++s) total += a_->survivors[s].corners.count;
  counts.rendered += end - first;
  counts.vertices += total;
  const bool attributes =
      wants_.opacities || wants_.textures || wants_.normals || wants_.eye_positions || wants_.vertex_ids;
  if (triangles_only_) {
    for (std::size_t s = first; s < end; ++s) {
      const Survivor& survivor = a_->survivors[s];
      const std::size_t start = batch.vertices.size();
      batch.vertices.resize(start + survivor.corners.count);
      write_vertices(s, batch.vertices.data() + start);
      if (attributes) append_attributes(s, batch);
      positions_.clear();
      for (std::size_t i = 0; i < survivor.corners.count; ++i)
        positions_.push_back(a_->positions.at(a_->item[survivor.first_corner + i]));
      plain_.append_triangles(positions_, a_->planes.at(survivor.plane), *placed_, survivor.faces_away, batch,
                              counts);
    }
    return;
  }
  std::size_t start = batch.vertices.size();
  batch.vertices.resize(start + total);
  for (std::size_t s = first; s < end; ++s) {
    const Survivor& survivor = a_->survivors[s];
    write_vertices(s, batch.vertices.data() + start);
    if (attributes) append_attributes(s, batch);
    PlainStage::append_record(start, survivor.corners.count, *placed_, survivor.faces_away, batch);
    start += survivor.corners.count;
  }
}

inline void BatchedStage::write_vertices(std::size_t s, ScreenVertex* out) const {
  const Survivor survivor = a_->survivors[s];
  const Arrays& a = *a_;
  const bool flat = options_.flat;
  const std::uint32_t* red_green = flat ? a.flat_colors.red_green : a.colors.red_green;
  const std::uint32_t* blue = flat ? a.flat_colors.blue : a.colors.blue;
  for (std::size_t i = 0; i < survivor.corners.count; ++i) {
    const std::uint32_t item = a.item[survivor.first_corner + i];
    const std::size_t lit = flat ? s : item;
    ScreenVertex v;
    v.x = a.x[item], v.y = a.y[item], v.z = a.z[item];
    v.r = static_cast<std::uint16_t>(red_green[lit]);
    v.g = static_cast<std::uint16_t>(red_green[lit] >> 16);
    v.b = static_cast<std::uint16_t>(blue[lit]);
    out[i] = v;
  }
}

void BatchedStage::append_attributes(std::size_t s, ScreenPolygonBatch& batch) const {
  const std::vector<V3f>& textures = placed_->surface.textures;
  const Survivor& survivor = a_->survivors[s];
  for (std::size_t i = 0; i < survivor.corners.count; ++i) {
    const std::uint32_t item = a_->item[survivor.first_corner + i];
    if (wants_.opacities)
      batch.opacities.push_back(options_.flat ? a_->flat_opacities[s] : a_->opacities[item]);
    if (wants_.textures)
      batch.textures.push_back(textures.empty() ? V3f(0, 0, 0) : textures[a_->vertex[item]]);
    if (wants_.normals) batch.normals.emplace_back(a_->normals.at(item));
    if (wants_.eye_positions) batch.eye_positions.emplace_back(a_->positions.at(item));
    if (wants_.vertex_ids) batch.vertex_ids.push_back(a_->vertex[item]);
  }
}

}  // namespace farop::batched
