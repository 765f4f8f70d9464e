// SPDX-License-Identifier: GPL-3.0-or-later
// Fills a surface corner by corner and merges equal vertices on the way.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/surface.h"

namespace farop {

/// Two corners become one vertex when position and given normal are equal bit for bit (so 0 and -0 differ, as
/// read); a corner with a given normal never joins one without. Vertices are numbered in order of first use.
/// Memory: 6 to 11 bytes a vertex for the hash table on top of the surface, until take(); nothing is copied
/// while the surface grows, whatever its size.
class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const Material& material = {}) : material_(material) {}

  void begin_polygon(bool has_given_normals);
  void add_corner(const V3d& position);
  void add_corner(const V3d& position, const V3d& normal);
  void end_polygon() { polygons_.end_polygon(); }
  /// Whole polygons of one kind. `numbers`: x y z of every corner, with `has_given_normals` x y z nx ny nz;
  /// `corner_counts`: of every polygon. The same as corner by corner, but faster: many corners are looked for
  /// at once.
  void add_polygons(std::span<const double> numbers, std::span<const std::uint32_t> corner_counts,
                    bool has_given_normals);
  /// Everything of a surface that another builder made, as if its corners had been added here.
  void append(const Surface& surface);
  /// Takes back the open polygon; vertices that only it used stay, unused (the caller skips polygons before
  /// adding corners wherever it can).
  void cancel_polygon() { polygons_.cancel_polygon(); }
  void add(const Sphere& sphere);
  void add(const Cone& cone);

  /// Of the surface that is being built.
  const Material& material() const { return material_; }
  /// Of what is in it, without the hash table.
  std::size_t memory_bytes() const {
    return (positions_.size() + normals_.size()) * sizeof(V3d) + polygons_.memory_bytes() +
           curved_.size() * sizeof(CurvedPrimitive);
  }
  std::size_t curved_count() const { return curved_.size(); }
  bool empty() const { return polygons_.empty() && curved_.empty(); }
  /// The finished surface, its memory exactly what it holds; the builder is empty afterwards and keeps its
  /// table for reuse.
  Surface take(const Material& next_material = {});

 private:
  std::uint32_t vertex(const V3d& position, const V3d& normal, bool given);
  /// The vertices of `count` corners, corner(i) = {position, normal}, into vertices_.
  template <class Corner>
  void find_vertices(std::size_t count, bool given, const Corner& corner);
  std::uint32_t find_vertex(std::uint64_t hash, const V3d& position, const V3d& normal, bool given);
  void see_corners(bool given);
  bool mixed() const { return any_plain_ && any_given_; }
  /// Makes the table large enough for so many vertices more.
  void make_room(std::size_t vertices);

  Material material_;
  ChunkedArray<V3d> positions_;
  ChunkedArray<V3d> normals_;  ///< empty while no polygon has given ones
  PolygonRecorder polygons_;
  std::vector<CurvedPrimitive> curved_;
  std::vector<std::uint64_t> hashes_;  ///< of the corners that are looked for at once
  std::vector<std::uint32_t> vertices_;
  std::vector<std::uint32_t> table_;  ///< open addressing; vertex index + 1, 0 = free
  std::vector<bool> given_;           ///< per vertex: has a given normal; empty while all vertices agree
  bool any_given_ = false;
  bool any_plain_ = false;
};

}  // namespace farop
