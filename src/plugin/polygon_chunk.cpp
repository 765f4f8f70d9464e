// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/polygon_chunk.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/math.h"
#include "shading/material.h"

namespace farop {
namespace {

farop_vec3 to_vec3(const V3f& v) {
  return {v.x, v.y, v.z};
}

farop_material to_material(const Material& m, std::uint32_t id) {
  const auto f = [](double v) { return static_cast<float>(v); };
  return {sizeof(farop_material),
          id,
          {f(m.color.r), f(m.color.g), f(m.color.b)},
          f(m.ka),
          f(m.kd),
          f(m.ks),
          f(m.shine),
          {f(m.opacity().r), f(m.opacity().g), f(m.opacity().b)}};
}

/// Where the arrays of a packed chunk lie, bytes from its start.
struct Layout {
  std::size_t polygons = 0, materials = 0, normals = 0, eye_positions = 0, vertex_ids = 0, vertices = 0,
              end = 0;
};

/// First bytes of a packed chunk.
struct Header {
  std::uint32_t polygons = 0, vertices = 0, materials = 0, wants = 0, first_index = 0, reserved[3] = {};
};

std::size_t round_up(std::size_t bytes) {
  return (bytes + 15) & ~std::size_t{15};
}

Layout layout_of(const Header& h) {
  Layout at;
  std::size_t next = sizeof(Header);
  const auto place = [&](std::size_t& where, std::size_t count, std::size_t size) {
    where = next;
    next = round_up(next + count * size);
  };
  const auto wanted = [&](std::uint32_t wish) { return (h.wants & wish) != 0 ? std::size_t{h.vertices} : 0; };
  place(at.polygons, h.polygons, sizeof(ChunkPolygon));
  place(at.materials, h.materials, sizeof(farop_material));
  place(at.normals, wanted(FAROP_WANT_NORMALS), sizeof(farop_vec3));
  place(at.eye_positions, wanted(FAROP_WANT_EYE_POSITIONS), sizeof(farop_vec3));
  place(at.vertex_ids, wanted(FAROP_WANT_VERTEX_IDS), sizeof(std::uint32_t));
  place(at.vertices, h.vertices, sizeof(farop_vertex));
  at.end = next;
  return at;
}

Header header_of(const PolygonChunkView& chunk) {
  Header header;
  header.polygons = static_cast<std::uint32_t>(chunk.polygons.size());
  header.vertices = static_cast<std::uint32_t>(chunk.vertices.size());
  header.materials = static_cast<std::uint32_t>(chunk.materials.size());
  // What was asked for but is not there (a flat file has no normals) is not there in the block either.
  if (chunk.normals != nullptr) header.wants |= FAROP_WANT_NORMALS;
  if (chunk.eye_positions != nullptr) header.wants |= FAROP_WANT_EYE_POSITIONS;
  if (chunk.vertex_ids != nullptr) header.wants |= FAROP_WANT_VERTEX_IDS;
  header.first_index = chunk.first_index;
  return header;
}

template <class T>
void copy_array(std::span<std::byte> memory, std::size_t at, const std::vector<T>& values) {
  if (!values.empty()) std::memcpy(memory.data() + at, values.data(), values.size() * sizeof(T));
}

}  // namespace

bool is_convex(std::span<const farop_vertex> corners) {
  struct Step {
    std::int64_t x, y;
  };
  // Turns all of one sign, and one change from going left to going right (by row, then column) each way: once
  // round.
  std::int64_t turn = 0;
  int direction_changes = 0;
  Step first{0, 0}, previous{0, 0};
  bool any = false;
  const auto ascends = [](const Step& s) { return s.y > 0 || (s.y == 0 && s.x > 0); };
  const auto corner = [&](const Step& a, const Step& b) {
    const std::int64_t cross = a.x * b.y - a.y * b.x;
    if (cross != 0) {
      if ((cross > 0) != (turn > 0) && turn != 0) return false;
      turn = cross;
    } else if (a.x * b.x + a.y * b.y < 0) {
      return false;  // out and back
    }
    if (ascends(a) != ascends(b)) ++direction_changes;
    return true;
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const farop_vertex& from = corners[i];
    const farop_vertex& to = corners[i + 1 < corners.size() ? i + 1 : 0];
    const Step step{std::int64_t{to.x} - from.x, std::int64_t{to.y} - from.y};
    if (step.x == 0 && step.y == 0) continue;
    if (!any) {
      first = step;
    } else if (!corner(previous, step)) {
      return false;
    }
    previous = step;
    any = true;
  }
  return any && corner(previous, first) && turn != 0 && direction_changes == 2;
}

void PolygonChunk::begin_frame(int color_resolution) {
  clear();
  first_index_ = 0;
  bytes_of_color_.clear();
  if (color_resolution == 256) return;
  const double scale = 255.0 / (color_resolution - 1);
  for (int c = 0; c < color_resolution; ++c) {
    bytes_of_color_.push_back(static_cast<std::uint8_t>(round_half_up(scale * c)));
  }
}

void PolygonChunk::append(const ScreenPolygonBatch& batch) {
  const auto byte = [&](std::uint16_t c) {
    return bytes_of_color_.empty() ? static_cast<std::uint8_t>(c) : bytes_of_color_[c];
  };
  const bool normals = (wants_ & FAROP_WANT_NORMALS) != 0 && !batch.normals.empty();
  const bool positions = (wants_ & FAROP_WANT_EYE_POSITIONS) != 0 && !batch.eye_positions.empty();
  const bool ids = (wants_ & FAROP_WANT_VERTEX_IDS) != 0 && !batch.vertex_ids.empty();
  for (const ScreenPolygonRecord& record : batch.polygons) {
    ChunkPolygon polygon;
    polygon.first_vertex = static_cast<std::uint32_t>(vertices_.size());
    polygon.vertex_count = record.vertex_count;
    polygon.surface_id = record.surface_id;
    polygon.object_id = record.object_id;
    for (std::uint32_t i = 0; i < record.vertex_count; ++i) {
      const std::size_t from = std::size_t{record.first_vertex} + i;
      const ScreenVertex& v = batch.vertices[from];
      vertices_.push_back({v.x, v.y, v.z, byte(v.r), byte(v.g), byte(v.b), 0});
      if (normals) normals_.push_back(to_vec3(batch.normals[from]));
      if (positions) eye_positions_.push_back(to_vec3(batch.eye_positions[from]));
      if (ids) vertex_ids_.push_back(batch.vertex_ids[from]);
    }
    if (is_convex({vertices_.data() + polygon.first_vertex, polygon.vertex_count})) {
      polygon.flags |= FAROP_POLYGON_CONVEX;
    }
    if (record.back_facing) polygon.flags |= FAROP_POLYGON_BACK_FACING;
    if ((wants_ & FAROP_WANT_MATERIAL) != 0 && record.material != nullptr) {
      const auto [found, is_new] =
          material_numbers_.try_emplace(record.surface_id, static_cast<std::uint32_t>(materials_.size() + 1));
      if (is_new) materials_.push_back(to_material(*record.material, record.surface_id));
      polygon.material = found->second;
    }
    polygons_.push_back(polygon);
  }
}

void PolygonChunk::clear() {
  first_index_ += static_cast<std::uint32_t>(polygons_.size());
  polygons_.clear(), vertices_.clear(), normals_.clear(), eye_positions_.clear(), vertex_ids_.clear();
  materials_.clear(), material_numbers_.clear();
}

PolygonChunkView PolygonChunk::view() const {
  PolygonChunkView view;
  view.polygons = polygons_;
  view.vertices = vertices_;
  view.normals = normals_.empty() ? nullptr : normals_.data();
  view.eye_positions = eye_positions_.empty() ? nullptr : eye_positions_.data();
  view.vertex_ids = vertex_ids_.empty() ? nullptr : vertex_ids_.data();
  view.materials = materials_;
  view.first_index = first_index_;
  return view;
}

std::size_t PolygonChunk::packed_bytes() const {
  return layout_of(header_of(view())).end;
}

void PolygonChunk::pack(std::span<std::byte> memory) const {
  const Header header = header_of(view());
  const Layout at = layout_of(header);
  std::memcpy(memory.data(), &header, sizeof header);
  copy_array(memory, at.polygons, polygons_);
  copy_array(memory, at.materials, materials_);
  copy_array(memory, at.normals, normals_);
  copy_array(memory, at.eye_positions, eye_positions_);
  copy_array(memory, at.vertex_ids, vertex_ids_);
  copy_array(memory, at.vertices, vertices_);
}

std::optional<PolygonChunkView> PolygonChunk::unpack(std::span<const std::byte> memory) {
  Header header;
  if (memory.size() < sizeof header) return std::nullopt;
  std::memcpy(&header, memory.data(), sizeof header);
  const Layout at = layout_of(header);
  if (at.end != memory.size()) return std::nullopt;
  const auto array = [&]<class T>(std::size_t offset, const T*) {
    return reinterpret_cast<const T*>(memory.data() + offset);
  };
  PolygonChunkView view;
  view.polygons = {array(at.polygons, static_cast<const ChunkPolygon*>(nullptr)), header.polygons};
  view.vertices = {array(at.vertices, static_cast<const farop_vertex*>(nullptr)), header.vertices};
  view.materials = {array(at.materials, static_cast<const farop_material*>(nullptr)), header.materials};
  const auto optional_array = [&]<class T>(std::uint32_t wish, std::size_t offset,
                                           const T* type) -> const T* {
    return (header.wants & wish) != 0 ? array(offset, type) : nullptr;
  };
  view.normals = optional_array(FAROP_WANT_NORMALS, at.normals, static_cast<const farop_vec3*>(nullptr));
  view.eye_positions =
      optional_array(FAROP_WANT_EYE_POSITIONS, at.eye_positions, static_cast<const farop_vec3*>(nullptr));
  view.vertex_ids =
      optional_array(FAROP_WANT_VERTEX_IDS, at.vertex_ids, static_cast<const std::uint32_t*>(nullptr));
  view.first_index = header.first_index;
  for (const ChunkPolygon& polygon : view.polygons) {
    if (std::uint64_t{polygon.first_vertex} + polygon.vertex_count > header.vertices ||
        polygon.material > header.materials) {
      return std::nullopt;
    }
  }
  return view;
}

farop_status play_chunk(const farop_rasterizer& rasterizer, void* self, const PolygonChunkView& chunk,
                        volatile std::uint32_t* current) {
  farop_polygon polygon{};
  polygon.struct_size = sizeof polygon;
  std::uint32_t index = chunk.first_index;
  const auto at = [](const auto* array, std::uint32_t first) {
    return array == nullptr ? nullptr : array + first;
  };
  for (const ChunkPolygon& p : chunk.polygons) {
    *current = index;
    polygon.vertex_count = p.vertex_count;
    polygon.vertices = chunk.vertices.data() + p.first_vertex;
    polygon.normals = at(chunk.normals, p.first_vertex);
    polygon.eye_positions = at(chunk.eye_positions, p.first_vertex);
    polygon.vertex_ids = at(chunk.vertex_ids, p.first_vertex);
    polygon.material = p.material == 0 ? nullptr : &chunk.materials[p.material - 1];
    polygon.index = index++;
    polygon.flags = p.flags;
    polygon.surface_id = p.surface_id;
    polygon.object_id = p.object_id;
    const farop_status status = rasterizer.polygon(self, &polygon);
    if (status < 0) return status;
  }
  return FAROP_OK;
}

}  // namespace farop
