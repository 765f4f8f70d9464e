// SPDX-License-Identifier: GPL-3.0-or-later
// What the geometry stage hands over: polygons in integer device coordinates, in batches.
//
// Conventions (the same in the flat file, for rasterizers and in frame memory):
//   x grows to the right, y upwards, row 0 is the bottom row; z = 0 is nearest, depth_resolution - 1
//   farthest; a whole pixel coordinate is a pixel centre, coordinates come in units of 1 / 2^subpixel_bits
//   pixel; front faces run counter-clockwise. Under y_down rows count from the top, vertex order stays.
// A batch keeps every attribute in an array of its own (structure of arrays by attribute group), so that a
// fast rasterizer can set up many triangles at once without gathering.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/color.h"
#include "core/math.h"

namespace farop {

struct Material;
class Shader;

/// XRES x YRES pixels, ZRES depths, CRES intensities per channel. Defaults: farop.md section 3.
struct Resolution {
  int x = 512, y = 512;
  std::int64_t z = 65536;
  int color = 256;

  friend bool operator==(const Resolution&, const Resolution&) = default;
};

/// One corner on the screen. x lies in 0 .. (XRES-1) << subpixel_bits, likewise y; with
/// ScreenFrame::half_pixel_border in -h .. (XRES << subpixel_bits) - h with h = half a pixel. 0 <= z < ZRES;
/// r, g, b lit colour 0..CRES-1.
struct ScreenVertex {
  std::int32_t x = 0, y = 0, z = 0;
  std::uint16_t r = 0, g = 0, b = 0;
  std::uint16_t reserved = 0;

  friend bool operator==(const ScreenVertex&, const ScreenVertex&) = default;
};

/// One polygon of a batch: corners first_vertex .. first_vertex + vertex_count - 1 of the batch's arrays.
/// No holes. Clipping a concave polygon may leave an edge that is walked twice; rounding may leave no area,
/// or turn over a polygon thinner than a pixel: odd-even parity says what is inside, `back_facing` says how
/// it faces.
struct ScreenPolygonRecord {
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;
  const Material* material = nullptr;  ///< lives as long as the frame; nullptr: opaque, colours as given
  bool back_facing = false;  ///< faced away from the eye (two-sided drawing, or a clockwise flat-file record)
  std::uint32_t surface_id = 0;  ///< surfaces of the scene count from 1 in tree order; 0: from a flat file
  std::uint32_t object_id = 0;   ///< placed objects count from 1 in tree order; 0: from a flat file
  /// What lights it instead of the material's reflection model; lives as long as the frame. nullptr: nothing.
  const Shader* shader = nullptr;
};

/// ScreenPolygonBatch::vertex_ids of a corner that clipping made.
constexpr std::uint32_t k_no_vertex_id = 0xFFFFFFFFu;

/// Polygons in drawing order. What follows `vertices` is empty unless the sink wants
/// it (and there is a scene to take it from); then it runs parallel to `vertices`.
struct ScreenPolygonBatch {
  std::vector<ScreenPolygonRecord> polygons;
  std::vector<ScreenVertex> vertices;
  std::vector<V3f> normals;        ///< unit length, eye space, turned towards the lit side
  std::vector<V3f> eye_positions;  ///< eye space: x right, y up, z along the view direction; scene units
  /// Index of the corner's vertex in its surface: equal object, surface and vertex id = the same corner.
  std::vector<std::uint32_t> vertex_ids;
  std::vector<V3f> textures;   ///< texture coordinates; 0 0 0 where the surface has none
  std::vector<V3f> opacities;  ///< per channel, 1 = nothing behind is seen

  std::span<const ScreenVertex> corners(const ScreenPolygonRecord& polygon) const {
    return {vertices.data() + polygon.first_vertex, polygon.vertex_count};
  }
  void clear() {
    polygons.clear(), vertices.clear(), normals.clear(), eye_positions.clear(), vertex_ids.clear();
    textures.clear(), opacities.clear();
  }
};

/// Everything about a frame that is known before its first polygon.
struct ScreenFrame {
  Resolution resolution;
  int subpixel_bits = 0;
  bool y_down = false;
  /// Corners reach half a pixel beyond the outermost pixel centres (window edges mapped, with sub-pixel
  /// bits), so that under the fill rule `lb` the last column and the top row are drawn. Only the internal
  /// rasterizer gets such frames.
  bool half_pixel_border = false;
  /// No polygon of the frame has more corners; 0 where the sink did not ask.
  std::uint32_t max_vertices = 0;
};

/// What a sink needs beside device coordinates and colours. The rest stays empty and costs nothing.
struct PolygonWants {
  bool triangles = false;      ///< nothing but triangles
  bool normals = false;        ///< ScreenPolygonBatch::normals
  bool eye_positions = false;  ///< ScreenPolygonBatch::eye_positions
  bool vertex_ids = false;     ///< ScreenPolygonBatch::vertex_ids
  bool textures = false;       ///< ScreenPolygonBatch::textures
  bool opacities = false;      ///< ScreenPolygonBatch::opacities
  bool max_vertices = false;   ///< ScreenFrame::max_vertices; takes a look at every polygon of the scene
};

/// Where screen polygons go: a rasterizer, the flat file, a counter, a test recorder.
/// begin_frame, polygons any number of times, end_frame. Throws farop::Error when it cannot go on.
class ScreenPolygonSink {
 public:
  virtual ~ScreenPolygonSink() = default;
  virtual PolygonWants wants() const { return {}; }
  virtual void begin_frame(const ScreenFrame& frame) = 0;
  virtual void polygons(const ScreenPolygonBatch& batch) = 0;
  virtual void end_frame() = 0;
};

}  // namespace farop
