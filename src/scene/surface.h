// SPDX-License-Identifier: GPL-3.0-or-later
// A surface: one material, a vertex list and the polygons that share it, stored compactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/chunked_array.h"
#include "core/math.h"
#include "shading/material.h"
#include "shading/shader.h"

namespace farop {

/// One polygon of a surface: planar, convex or concave, no holes, at least 3 corners, counter-clockwise seen
/// from the front. Corners are indices into the surface's vertex arrays.
struct PolygonView {
  std::span<const std::uint32_t> corners;
  bool has_given_normals = false;  ///< NFF `pp`: Surface::normals holds a normal for every corner
};

/// Polygons in order, as one stream of records [corner count and flag][corner]...: 4 bytes a polygon beside
/// its corners, so that scenes of 10^8 polygons fit in memory. Read front to back only.
class PolygonList {
 public:
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = PolygonView;
    using difference_type = std::ptrdiff_t;
    using pointer = const PolygonView*;
    using reference = PolygonView;

    Iterator() = default;
    explicit Iterator(const std::uint32_t* at) : at_(at) {}
    PolygonView operator*() const { return {{at_ + 1, *at_ & k_count_mask}, (*at_ & k_given_normals) != 0}; }
    Iterator& operator++() {
      at_ += 1 + (*at_ & k_count_mask);
      return *this;
    }
    Iterator operator++(int) {
      Iterator old = *this;
      ++*this;
      return old;
    }
    friend bool operator==(const Iterator&, const Iterator&) = default;

   private:
    const std::uint32_t* at_ = nullptr;
  };

  PolygonList() = default;
  /// `records` as PolygonRecorder makes them, `count` polygons.
  PolygonList(std::vector<std::uint32_t> records, std::uint64_t count)
      : records_(std::move(records)), count_(count) {}

  Iterator begin() const { return Iterator(records_.data()); }
  Iterator end() const { return Iterator(records_.data() + records_.size()); }
  std::uint64_t size() const { return count_; }
  bool empty() const { return count_ == 0; }

  std::size_t memory_bytes() const { return records_.capacity() * sizeof(std::uint32_t); }
  /// All records as they lie in memory: for passing a list on whole.
  std::span<const std::uint32_t> records() const { return records_; }

  friend bool operator==(const PolygonList&, const PolygonList&) = default;

 private:
  friend class PolygonRecorder;
  static constexpr std::uint32_t k_given_normals = 0x80000000u;
  static constexpr std::uint32_t k_count_mask = 0x3FFFFFFFu;

  std::vector<std::uint32_t> records_;
  std::uint64_t count_ = 0;
};

/// Writes the records of a PolygonList, without ever copying them while they grow.
class PolygonRecorder {
 public:
  /// Opens a record; its corners follow with add_corner(), then end_polygon().
  void begin_polygon(bool has_given_normals);
  void add_corner(std::uint32_t vertex) { records_.push_back(vertex); }
  void end_polygon();
  /// A whole record.
  void add_polygon(std::span<const std::uint32_t> corners, bool has_given_normals);
  /// Drops the record that is open, with its corners.
  void cancel_polygon() { records_.truncate(open_); }

  std::uint64_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  std::size_t memory_bytes() const { return records_.size() * sizeof(std::uint32_t); }
  /// The finished list; the recorder is empty afterwards.
  PolygonList take();

 private:
  ChunkedArray<std::uint32_t> records_;
  std::uint64_t count_ = 0;
  std::size_t open_ = 0;  ///< where the record that was opened last begins
};

/// NFF `s`. Radius > 0; inside_visible: only the inside is seen (NFF: a negative radius).
struct Sphere {
  V3d center{0, 0, 0};
  double radius = 0;
  bool inside_visible = false;
  friend bool operator==(const Sphere&, const Sphere&) = default;
};

/// NFF `c`: open cone or cylinder without end caps. Radii >= 0, not both 0; base != apex.
struct Cone {
  V3d base{0, 0, 0};
  double base_radius = 0;
  V3d apex{0, 0, 0};
  double apex_radius = 0;
  bool inside_visible = false;
  friend bool operator==(const Cone&, const Cone&) = default;
};

/// A sphere or cone, and the number of polygons of its surface that stand before it.
struct CurvedPrimitive {
  enum class Kind : std::uint8_t { sphere, cone };
  Kind kind = Kind::sphere;
  Sphere sphere;
  Cone cone;
  std::uint64_t after_polygons = 0;
  friend bool operator==(const CurvedPrimitive&, const CurvedPrimitive&) = default;
};

/// How vertex normals reach eye space. nff: by the inverse transpose of the object's matrix; a given one that
/// points to the back of its polygon is turned round. sipp: by the matrix itself, never turned round (so that
/// scaling that is not uniform bends them, as it does in SIPP 3.1).
enum class NormalRule : std::uint8_t { nff, sipp };

/// Material + vertices + polygons (+ curved primitives until loading ends). Local coordinates, right-handed.
struct Surface {
  Material material;                     ///< with a shader: its nearest approximation in NFF's terms
  std::shared_ptr<const Shader> shader;  ///< nullptr: the reflection model of shading/reflection.h
  NormalRule normal_rule = NormalRule::nff;
  std::vector<V3d> positions;
  /// Given normals as read (any length), parallel to positions; empty when no polygon has any. Entries of
  /// vertices whose polygons have none are 0 0 0 and mean nothing.
  std::vector<V3d> normals;
  /// Averages over the polygons that share a vertex, parallel to positions, unit length or zero (then the
  /// plane normal serves); empty unless average_normals() (scene/plane.h) made them. Of surfaces from SIPP
  /// (NormalRule::sipp) given ones stand here too, in the place of averages; of others this is not part of
  /// what was read.
  std::vector<V3d> averaged_normals;
  /// Texture coordinates u v w, parallel to positions; empty where no shader could want them.
  std::vector<V3f> textures;
  PolygonList polygons;
  std::vector<CurvedPrimitive> curved;
  /// Degenerate triangles that tessellating pointed cones made: expected, so nobody is warned of them.
  std::uint64_t cone_tip_triangles = 0;

  std::size_t memory_bytes() const;
  /// Equality of what was read: material, shader by its description, vertices, polygons, curved primitives;
  /// averaged normals under NormalRule::sipp alone.
  friend bool operator==(const Surface& a, const Surface& b);
};

}  // namespace farop
