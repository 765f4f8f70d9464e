// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/batched/batched_stage.h"

#include <algorithm>
#include <optional>

#include "scene/plane.h"

namespace farop::batched {
namespace {

/// A chunk is full when its polygons have so many corners: its arrays then stay in the L2 cache.
constexpr std::size_t k_full_corners = 1024;
/// Polygons of more corners go to PlainStage.
constexpr std::size_t k_long_polygon = 512;
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
  // By polygon, then by survivor.
  Points<k_max_polygons + k_lanes> planes;
  bool degenerate[k_max_polygons], faces_away[k_max_polygons];
  // By survivor: flat shading's one corner.
  Points<k_max_polygons + k_lanes> flat_positions, flat_normals;
  Colors<k_max_polygons + k_lanes> flat_colors;
  V3f flat_opacities[k_max_polygons];

  std::uint32_t slots[k_slots];
  PolygonGroup group;
  GroupPlanes group_planes;
};

BatchedStage::BatchedStage(const GeometrySetup& setup, const GeometryOptions& options,
                           const PolygonWants& wants)
    : setup_(setup),
      options_(options),
      wants_(wants),
      mapping_(setup.device_mapping()),
      frustum_(setup.frustum()),
      triangles_only_(options.triangles || wants.triangles),
      plain_(setup, options, wants),
      lighting_(setup.shading, mapping_),
      a_(std::make_unique<Arrays>()) {}

BatchedStage::~BatchedStage() = default;

void BatchedStage::run(const Piece& piece, ScreenPolygonBatch& batch, PolygonCounts& counts) {
  placed_ = piece.placed;
  const Surface& surface = placed_->surface;
  const bool one_by_one = placed_->flattened || !is_affine(placed_->local_to_eye) ||
                          (surface.shader && !surface.shader->is_pure());
  PolygonList::Iterator at = piece.first;
  for (std::uint64_t i = 0; i < piece.polygons; ++i, ++at) {
    const PolygonView polygon = *at;
    if (one_by_one || polygon.corners.size() > k_long_polygon) {
      run_chunk(batch, counts);
      plain_.polygon(*placed_, polygon, batch, counts);
      continue;
    }
    const Normals kind = polygon.has_given_normals          ? Normals::given
                         : surface.averaged_normals.empty() ? Normals::of_plane
                                                            : Normals::averaged;
    if (kind != kind_ || corners_ >= k_full_corners) run_chunk(batch, counts);
    kind_ = kind;
    polygons_.push_back(polygon);
    corners_ += polygon.corners.size();
  }
  run_chunk(batch, counts);
}

void BatchedStage::run_chunk(ScreenPolygonBatch& batch, PolygonCounts& counts) {
  if (polygons_.empty()) return;
  find_planes();
  cull(counts);
  if (!survivors_.empty()) {
    collect_items();
    transform_points(placed_->local_to_eye, frustum_, items_, a_->positions.arrays(), a_->codes);
    drop_outside(counts);
    find_normals();
    project(mapping_.terms(), items_, a_->positions.arrays(), a_->x, a_->y, a_->z);
    light_items();
    append(batch, counts);
  }
  polygons_.clear();
  corners_ = 0;
}

void BatchedStage::find_planes() {
  const std::vector<V3d>& positions = placed_->surface.positions;
  PolygonGroup& group = a_->group;
  std::size_t members[k_lanes] = {};
  std::size_t count = 0;
  const auto flush = [&] {
    if (count == 0) return;
    for (std::size_t lane = count; lane < k_lanes; ++lane) group.count[lane] = 0;
    batched::find_planes(group, placed_->eye_local, a_->group_planes);
    const GroupPlanes& planes = a_->group_planes;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::size_t p = members[lane];
      a_->planes.set(p, V3d(planes.x[lane], planes.y[lane], planes.z[lane]));
      a_->degenerate[p] = (planes.degenerate >> lane & 1) != 0;
      a_->faces_away[p] = (planes.faces_away >> lane & 1) != 0;
    }
    count = 0, group.most = 0;
  };
  group.most = 0;
  for (std::size_t p = 0; p < polygons_.size(); ++p) {
    const std::span<const std::uint32_t> corners = polygons_[p].corners;
    if (corners.size() > PolygonGroup::k_corners) {
      const std::optional<V3d> normal = plane_normal(positions, corners);
      a_->degenerate[p] = !normal;
      if (!normal) continue;
      a_->planes.set(p, *normal);
      a_->faces_away[p] = normal->dot(positions[corners.front()] - placed_->eye_local) >= 0;
      continue;
    }
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const V3d& position = positions[corners[c]];
      group.x[c][count] = position.x, group.y[c][count] = position.y, group.z[c][count] = position.z;
    }
    const V3d& last = positions[corners.back()];
    group.last_x[count] = last.x, group.last_y[count] = last.y, group.last_z[count] = last.z;
    group.count[count] = static_cast<double>(corners.size());
    group.most = std::max(group.most, corners.size());
    members[count] = p;
    if (++count == k_lanes) flush();
  }
  flush();
}

void BatchedStage::cull(PolygonCounts& counts) {
  survivors_.clear();
  counts.loaded += polygons_.size();
  std::uint32_t corner = 0;
  for (std::size_t p = 0; p < polygons_.size(); ++p) {
    if (a_->degenerate[p]) {
      ++counts.degenerate;
      continue;
    }
    const bool faces_away = a_->faces_away[p];
    if (faces_away && !options_.two_sided) {
      ++counts.back_facing;
      continue;
    }
    const auto plane = static_cast<std::uint32_t>(survivors_.size());
    a_->planes.set(plane, a_->planes.at(p));
    survivors_.push_back({polygons_[p], corner, plane, faces_away, false});
    corner += static_cast<std::uint32_t>(polygons_[p].corners.size());
  }
  transform_directions(placed_->normal_to_eye, survivors_.size(), a_->planes.arrays());
}

void BatchedStage::collect_items() {
  const std::vector<V3d>& positions = placed_->surface.positions;
  const bool shared = kind_ != Normals::of_plane;
  std::uint32_t items = 0, corner = 0;
  for (const Survivor& survivor : survivors_) {
    const std::span<const std::uint32_t> corners = survivor.polygon.corners;
    const std::size_t size = corners.size();
    for (std::size_t i = 0; i < size; ++i, ++corner) {
      // The first stays the first; of a mirrored polygon the others come the other way round.
      const std::uint32_t v = corners[placed_->mirrored && i > 0 ? size - i : i];
      if (shared) {
        std::uint32_t& slot = a_->slots[v % k_slots];
        if (slot < items && a_->vertex[slot] == v) {
          a_->item[corner] = slot;
          continue;
        }
        slot = items;
      }
      a_->item[corner] = items;
      a_->vertex[items] = v;
      a_->positions.set(items, positions[v]);
      ++items;
    }
  }
  items_ = items;
}

// Polygons outside one plane are dropped, those that a plane cuts are left alone; items of neither are not
// worked on any further.
void BatchedStage::drop_outside(PolygonCounts& counts) {
  bool all_inside = true;
  auto kept = survivors_.begin();
  for (Survivor& survivor : survivors_) {
    std::uint32_t any = 0, all = ~0u;
    const std::uint32_t* item = a_->item + survivor.first_corner;
    for (std::size_t i = 0; i < survivor.polygon.corners.size(); ++i) {
      const std::uint32_t code = a_->codes[item[i]];
      any |= code, all &= code;
    }
    if (any != 0) all_inside = false;
    if (all != 0) {
      ++counts.totally_clipped;
      continue;
    }
    survivor.cut = any != 0;
    *kept++ = survivor;
  }
  survivors_.erase(kept, survivors_.end());
  if (all_inside) return;

  const auto for_each_corner_inside = [&](const auto& visit) {
    for (const Survivor& survivor : survivors_) {
      if (survivor.cut) continue;
      std::uint32_t* item = a_->item + survivor.first_corner;
      for (std::size_t i = 0; i < survivor.polygon.corners.size(); ++i) visit(item[i]);
    }
  };
  std::fill_n(a_->other, items_, k_none);
  for_each_corner_inside([&](std::uint32_t item) { a_->other[item] = 0; });
  std::uint32_t items = 0;
  for (std::size_t i = 0; i < items_; ++i) {
    if (a_->other[i] == k_none) continue;
    a_->positions.set(items, a_->positions.at(i));
    a_->vertex[items] = a_->vertex[i];
    a_->other[i] = items++;
  }
  for_each_corner_inside([&](std::uint32_t& item) { item = a_->other[item]; });
  items_ = items;
}

void BatchedStage::find_normals() {
  if (kind_ == Normals::of_plane) {
    for (const Survivor& survivor : survivors_) {
      if (survivor.cut) continue;
      const V3d plane = a_->planes.at(survivor.plane);
      const V3d normal = survivor.faces_away ? -plane : plane;
      for (std::size_t i = 0; i < survivor.polygon.corners.size(); ++i)
        a_->normals.set(a_->item[survivor.first_corner + i], normal);
    }
    return;
  }
  const std::vector<V3d>& own = *placed_->vertex_normals(kind_ == Normals::given);
  for (std::size_t i = 0; i < items_; ++i) a_->normals.set(i, own[a_->vertex[i]]);
  const bool any_zero = transform_directions(placed_->vertex_normal_to_eye, items_, a_->normals.arrays());
  const bool may_turn =
      options_.two_sided || (kind_ == Normals::given && placed_->surface.normal_rule == NormalRule::nff);
  if (any_zero || may_turn) turn_normals();
}

// Corners whose normal is not that of their vertex get an item of their own, or the twin of their vertex's.
void BatchedStage::turn_normals() {
  const bool towards_front = kind_ == Normals::given && placed_->surface.normal_rule == NormalRule::nff;
  std::fill_n(a_->other, items_, k_none);
  for (const Survivor& survivor : survivors_) {
    if (survivor.cut) continue;
    const V3d plane = a_->planes.at(survivor.plane);
    for (std::size_t i = 0; i < survivor.polygon.corners.size(); ++i) {
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
    count = survivors_.size();
    opacities = a_->flat_opacities;
    for (std::size_t s = 0; s < count; ++s) {
      if (survivors_[s].cut) continue;
      const std::uint32_t item = a_->item[survivors_[s].first_corner];
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
      return V3d(surface.textures[a_->vertex[options_.flat ? a_->item[survivors_[i].first_corner] : i]]);
    };
    lighting_.by_shader(*surface.shader, count, lit, texture,
                        [&](std::size_t i, const Rgb& o) { opacities[i] = as_float(o); });
  }
}

void BatchedStage::append(ScreenPolygonBatch& batch, PolygonCounts& counts) {
  const auto is_cut = [](const Survivor& survivor) { return survivor.cut; };
  for (auto at = survivors_.cbegin(); at != survivors_.cend();) {
    const auto cut = std::find_if(at, survivors_.cend(), is_cut);
    append_inside({at, cut}, batch, counts);
    at = cut;
    for (; at != survivors_.cend() && at->cut; ++at) {
      --counts.loaded;  // PlainStage counts it again
      plain_.polygon(*placed_, at->polygon, batch, counts);
    }
  }
}

void BatchedStage::append_inside(std::span<const Survivor> run, ScreenPolygonBatch& batch,
                                 PolygonCounts& counts) {
  counts.rendered += run.size();
  const bool attributes =
      wants_.opacities || wants_.textures || wants_.normals || wants_.eye_positions || wants_.vertex_ids;
  std::size_t total = 0;
  for (const Survivor& survivor : run) total += survivor.polygon.corners.size();
  counts.vertices += total;
  std::size_t first = batch.vertices.size();
  if (!triangles_only_) batch.vertices.resize(first + total);
  for (const Survivor& survivor : run) {
    const std::size_t size = survivor.polygon.corners.size();
    if (triangles_only_) batch.vertices.resize(first + size);
    const std::uint32_t* items = a_->item + survivor.first_corner;
    const std::size_t s = static_cast<std::size_t>(&survivor - survivors_.data());
    ScreenVertex* out = batch.vertices.data() + first;
    for (std::size_t i = 0; i < size; ++i, ++out) {
      const std::uint32_t item = items[i];
      const std::uint32_t red_green =
          options_.flat ? a_->flat_colors.red_green[s] : a_->colors.red_green[item];
      const std::uint32_t blue = options_.flat ? a_->flat_colors.blue[s] : a_->colors.blue[item];
      out->x = a_->x[item], out->y = a_->y[item], out->z = a_->z[item];
      out->r = static_cast<std::uint16_t>(red_green);
      out->g = static_cast<std::uint16_t>(red_green >> 16);
      out->b = static_cast<std::uint16_t>(blue);
    }
    if (attributes) append_attributes(survivor, batch);
    if (triangles_only_) {
      positions_.clear();
      for (std::size_t i = 0; i < size; ++i) positions_.push_back(a_->positions.at(items[i]));
      plain_.append_triangles(positions_, a_->planes.at(survivor.plane), *placed_, survivor.faces_away, batch,
                              counts);
      first = batch.vertices.size();
    } else {
      PlainStage::append_record(first, size, *placed_, survivor.faces_away, batch);
      first += size;
    }
  }
}

void BatchedStage::append_attributes(const Survivor& survivor, ScreenPolygonBatch& batch) const {
  const std::vector<V3f>& textures = placed_->surface.textures;
  const std::size_t s = static_cast<std::size_t>(&survivor - survivors_.data());
  for (std::size_t i = 0; i < survivor.polygon.corners.size(); ++i) {
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
