// SPDX-License-Identifier: GPL-3.0-or-later
// Screen polygons in the form that a rasterizer gets them: arrays of the interface's own types.
//
// A chunk can be packed into one block of memory without pointers, so that another process reads it where it
// lies.
#pragma once

#include <farop/rasterizer.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/screen_polygon.h"

namespace farop {

/// One polygon of a chunk.
struct ChunkPolygon {
  std::uint32_t first_vertex = 0, vertex_count = 0;
  std::uint32_t flags = 0;  ///< FAROP_POLYGON_*
  std::uint32_t surface_id = 0, object_id = 0;
  std::uint32_t material = 0;  ///< number in the chunk's materials, from 1; 0: none
};

/// A chunk where it lies. Optional arrays are nullptr when they were not asked for; those that are there run
/// parallel to `vertices`. Valid as long as that memory.
struct PolygonChunkView {
  std::span<const ChunkPolygon> polygons;
  std::span<const farop_vertex> vertices;
  const farop_vec3* normals = nullptr;
  const farop_vec3* eye_positions = nullptr;
  const std::uint32_t* vertex_ids = nullptr;
  std::span<const farop_material> materials;
  std::uint32_t first_index = 0;  ///< number of the first polygon within the frame
};

/// Gathers batches of the geometry stage. Colours become 8 bits: round(255 c / (CRES - 1)).
class PolygonChunk {
 public:
  /// `wants`: FAROP_WANT_* of the rasterizer.
  explicit PolygonChunk(std::uint32_t wants) : wants_(wants) {}

  /// A frame begins: polygons are numbered from 0 again.
  void begin_frame(int color_resolution);
  void append(const ScreenPolygonBatch& batch);
  /// Empties the chunk; the numbers go on.
  void clear();
  bool empty() const { return polygons_.empty(); }
  std::size_t corner_count() const { return vertices_.size(); }
  PolygonChunkView view() const;

  /// Size of the chunk as one block; a multiple of 16.
  std::size_t packed_bytes() const;
  /// Copies the chunk to `memory` (packed_bytes() bytes, aligned to 16). The vertices come last, up to its
  /// end, so that a guard page behind it catches reads beyond them.
  void pack(std::span<std::byte> memory) const;
  /// A packed chunk; nothing when its numbers do not fit its size.
  static std::optional<PolygonChunkView> unpack(std::span<const std::byte> memory);

 private:
  std::uint32_t wants_;
  std::uint32_t first_index_ = 0;
  std::vector<std::uint8_t> bytes_of_color_;  ///< CRES -> 8 bits, by table; empty for CRES 256
  std::vector<ChunkPolygon> polygons_;
  std::vector<farop_vertex> vertices_;
  std::vector<farop_vec3> normals_, eye_positions_;
  std::vector<std::uint32_t> vertex_ids_;
  std::vector<farop_material> materials_;
  std::unordered_map<std::uint64_t, std::uint32_t> material_numbers_;  ///< by surface id
};

/// True for a polygon that turns one way only, once round, in integer screen coordinates; collinear and equal
/// corners do not disturb. One without area is not convex.
bool is_convex(std::span<const farop_vertex> corners);

/// Calls polygon() for every polygon of the chunk, in order, until one returns a negative status.
/// *current is set to a polygon's index within the frame before its call, so that whoever looks after a crash
/// knows where it happened. Returns the last status.
farop_status play_chunk(const farop_rasterizer& rasterizer, void* self, const PolygonChunkView& chunk,
                        volatile std::uint32_t* current);

}  // namespace farop
