// SPDX-License-Identifier: GPL-3.0-or-later
// SIPP's way to build a surface: push vertices, close polygons, create the surface.
//
// Source: SIPP 3.1, "SImple Polygon Processor", J. Yngvesson & I. Wallin, 1994: its documented behaviour.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/chunked_array.h"
#include "core/math.h"
#include "parse_sipp/vertex_table.h"
#include "scene/surface.h"

namespace farop::sipp {

/// One corner as it is pushed. Local coordinates, right-handed.
struct Vertex {
  V3d position{0, 0, 0};
  V3d texture{0, 0, 0};       ///< u v w
  std::optional<V3d> normal;  ///< of any length: kept as the vertex's own; nothing: averaged over polygons
};

/// A surface under construction: vertex set, vertex stack, polygon list. Push the corners of a polygon
/// counter-clockwise seen from the front, close it, and so on; then create the surface and start anew.
///
/// Equal vertices are merged: two are the same when every one of position, texture and (of vertices with
/// their own normal) normal differs by d at most, component by component; one with its own normal never
/// joins one without. Of several that fit, the one that was stored first. d = 1e-10 times the distance of the
/// first pushed vertex to the next one that lies elsewhere (1e-10 until there is one). What is not finite
/// joins nothing.
class SurfaceBuilder {
 public:
  SurfaceBuilder();

  void push_vertex(const Vertex& vertex);
  /// Makes the vertex stack a polygon and empties it. With fewer than three vertices on the stack there is no
  /// polygon (it would have no area): false.
  bool push_polygon();
  /// Forgets all polygons, the vertex set and the stack.
  void clear();

  /// No polygon is pending.
  bool empty() const { return counts_.empty(); }
  std::uint64_t polygon_count() const { return counts_.size(); }
  std::size_t vertex_count() const { return positions_.size(); }
  /// Which vertices have a normal of their own, by their index in the surface; empty when none has.
  const std::vector<bool>& own_normals() const { return has_normal_; }

  /// The finished surface, nullptr when no polygon is pending (then nothing changes). Its polygons are in
  /// SIPP's list order: the one pushed last comes first; their corners stay in the order pushed.
  /// averaged_normals holds every vertex's own normal, or the sum of the unit plane normals of its polygons,
  /// at unit length (or zero). normal_rule is sipp; the material approximates `shader`; textures are filled.
  /// Vertices that no polygon push closed stay on the stack and belong to the next surface.
  std::shared_ptr<Surface> create(std::shared_ptr<const Shader> shader);

 private:
  std::uint32_t stored(const Vertex& vertex);
  std::uint32_t find(const Vertex& vertex, const VertexKey& key) const;
  void update_tolerance(const V3d& position);
  void reset_vertices();

  ChunkedArray<V3d> positions_, textures_;
  ChunkedArray<V3d> normals_;                    ///< of vertices with their own; empty while there is none
  std::vector<bool> has_normal_;                 ///< as long as normals_
  std::vector<std::uint32_t> corners_, counts_;  ///< of all polygons, in the order pushed
  std::vector<Vertex> stack_;
  std::vector<std::uint32_t> stack_indices_;
  VertexTable table_;
  double tolerance_ = 0;
  bool tolerance_frozen_ = false;
};

}  // namespace farop::sipp
