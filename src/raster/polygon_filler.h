// SPDX-License-Identifier: GPL-3.0-or-later
// Draws filled polygons into a SampleBuffer: z-buffer with Gouraud or Phong interpolation.
//
// Interpolation is a function of the screen vertices alone:
//   - a polygon that its lowest corner sees all of (every convex one) is the fan of triangles from there;
//   - a triangle's values lie on the planes through its corners (triangle_planes.h), normals, positions,
//     textures and opacities too, by barycentric coordinates;
//   - other polygons, and the few triangles too large or too steep for fixed point, by scan lines: along the
//     two edges that bound a span to the row, then along the span. Every sample is computed from the corners
//     directly, not stepped, so errors do not add up.
// Positions and texture coordinates of surfaces with shaders follow the perspective (perspective.h); all else
// is linear on the screen.
// Results never leave the range of the corners. This is the plain path, row by row, one sample at a time; the
// fast one (tiled/) gives the same samples bit for bit. Sources: E. Catmull, "A Subdivision Algorithm for
// Computer Display of Curved Surfaces", PhD thesis, Utah 1974; H. Gouraud, "Continuous Shading of Curved
// Surfaces", IEEE Trans. Computers C-20(6), 1971; Bui Tuong Phong, CACM 18(6), 1975.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/color.h"
#include "core/math.h"
#include "core/screen_polygon.h"
#include "raster/edge_table.h"
#include "raster/raster_counts.h"
#include "raster/sample_buffer.h"
#include "raster/triangle_planes.h"
#include "shading/light.h"

namespace farop {

/// Colour 0..255, not rounded, and opacity 0..1.
struct LitFragment {
  V3f color{0, 0, 0}, opacity{1, 1, 1};
};

/// A surface point in eye space (eye at the origin); `normal` of any length.
LitFragment lit_fragment(const SurfaceLook& look, const ShadingFrame& shading, const V3d& position,
                         const V3d& normal, const V3d& texture);

/// One polygon and what runs parallel to its corners. `normals`, `eye_positions` and `textures`: in Phong
/// frames only, else empty. Without `opacities` the material's counts.
struct FillPolygon {
  std::span<const ScreenVertex> corners;
  std::span<const V3f> normals, eye_positions, textures, opacities;
  SurfaceLook look;
};

/// Strictly nearer wins, so of equal depths the first drawn stays. Transparent fragments are kept unless an
/// opaque one is at least as near already.
class PolygonFiller {
 public:
  /// `buffer`, `counts` and `shading` must outlive the filler. Phong: whether `buffer` has points.
  PolygonFiller(const ScreenFrame& frame, SampleBuffer& buffer, const ShadingFrame& shading,
                RasterCounts& counts);

  void fill(const FillPolygon& polygon);

 private:
  /// What is interpolated.
  struct Attributes {
    double depth = 0;
    V3d color{0, 0, 0};                      ///< 0..255
    V3d normal{0, 0, 0}, position{0, 0, 0};  ///< Phong only; Imath leaves vectors unset by default
    V3d texture{0, 0, 0};                    ///< Phong, where the shader wants it
    V3d opacity{1, 1, 1};                    ///< where the polygon is not opaque
  };

  class OnSpan;
  class OnPlanes;

  void load_attributes(const FillPolygon& polygon);
  void set_perspective(std::span<Attributes> corners, const SurfaceLook& look);
  Attributes at(const EdgePoint& point) const;
  void fill_by_scan_lines(std::span<const ScreenVertex> corners, const SurfaceLook& look);
  void fill_triangle(const std::array<std::uint32_t, 3>& numbers, const SurfaceLook& look);
  template <class Values>
  void fill_span(const Span& span, const Values& values, const SurfaceLook& look);

  SampleBuffer& buffer_;
  const ShadingFrame& shading_;
  RasterCounts& counts_;
  EdgeTable edge_table_;
  int subpixel_bits_, color_resolution_;
  bool phong_;
  // Of the polygon being filled.
  bool opaque_ = true, textured_ = false;
  bool perspective_ = false;  ///< of the part being filled: attributes are projected()
  std::uint32_t look_number_ = 0;
  std::vector<Attributes> attributes_;  ///< of the corners
  std::vector<ScreenVertex> corners_;   ///< colours 0..255
};

}  // namespace farop
