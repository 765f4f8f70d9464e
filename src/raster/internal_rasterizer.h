// SPDX-License-Identifier: GPL-3.0-or-later
// The rasterizer of the house: screen polygons in, a picture out.
//
// Does:      wire-frame, flat, Gouraud and Phong pictures; z-buffer; exact order-independent transparency
//            by the materials' opacity; super-sampling.
// Does not:  rows counted from the top (ScreenFrame::y_down); image textures.
// Coverage:  fill rule `lb`, exact on integers (edge_table.h). Depth: integers, rounded to nearest; strictly
//            nearer wins, of equal depths the first drawn stays. Colours: 8 bits (of another colour
//            resolution than 256, round(255 c / (CRES - 1)) at the corners), rounded once.
// Paths:     filled modes have a fast path (tiled/) and a plain one (polygon_filler.h) that draw the same
//            picture.
// Memory:    3 bytes a pixel of the result (7 with depth). Beside it the tiled path's waiting triangles
//            (tiled/tiled_frame.h); or the plain path's samples, 16 bytes each, Phong 32, 12 more once a
//            shader wants texture coordinates, 4 more once a transparent polygon is drawn, and 32 for every
//            transparent fragment visible when drawn.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/color.h"
#include "core/draw_mode.h"
#include "core/framebuffer.h"
#include "core/screen_polygon.h"
#include "raster/raster_counts.h"
#include "raster/raster_tuning.h"
#include "shading/light.h"

namespace farop {

namespace tiled {
class TiledFrame;
}

struct InternalRasterizerOptions {
  DrawMode mode = DrawMode::gouraud;
  int samples =
      1;  ///< degree A of super-sampling, 1..k_max_samples: A x A samples a pixel; line mode ignores it
  Rgb background;           ///< limited to 0..1
  bool keep_depth = false;  ///< fill Framebuffer::depth
  /// SIPP's transparency instead of the usual one: opacities of a pixel's fragments add up, near to far,
  /// until they reach 1.
  bool additive_transparency = false;
  ShadingFrame shading;  ///< phong: what fragments are lit with
  RasterTuning tuning;
};

/// Frames one after another: begin_frame, polygons any number of times, end_frame, take.
/// The frame given to begin_frame is that of the samples: A * XRES by A * YRES; vertices are in its
/// coordinates. Vertices outside the frame are safe: polygons are cut to it. Errors: Error(surroundings) when
/// memory runs out; Error(internal) for a frame or batch that breaks its contract: y_down, limits, a size
/// that A does not divide, in Phong mode missing normals or eye positions, wrong call order.
class InternalRasterizer : public ScreenPolygonSink {
 public:
  explicit InternalRasterizer(InternalRasterizerOptions options);
  ~InternalRasterizer() override;
  InternalRasterizer(const InternalRasterizer&) = delete;
  InternalRasterizer& operator=(const InternalRasterizer&) = delete;

  PolygonWants wants() const override {
    PolygonWants wants;
    wants.normals = wants.eye_positions = wants.textures = options_.mode == DrawMode::phong;
    wants.opacities = options_.mode == DrawMode::gouraud || options_.mode == DrawMode::flat;
    return wants;
  }
  void begin_frame(const ScreenFrame& frame) override;
  /// Materials are used until end_frame.
  void polygons(const ScreenPolygonBatch& batch) override;
  void end_frame() override;

  /// The finished picture, once per frame. Depth in line mode is ZRES everywhere: lines have none.
  Framebuffer take();
  /// Of the current or last frame; the plain path counts everything, line mode and the tiled path polygons
  /// alone.
  const RasterCounts& counts() const { return counts_; }

 private:
  struct FilledFrame;

  void draw_lines(const ScreenPolygonBatch& batch);
  void draw_filled(const ScreenPolygonBatch& batch);
  void make_picture();

  InternalRasterizerOptions options_;
  ScreenFrame frame_;
  std::vector<ScreenVertex> flat_corners_;  ///< scratch: corners that all have the first one's colour
  bool in_frame_ = false;
  std::unique_ptr<FilledFrame> filled_;       ///< while a frame of a filled mode is drawn, plain path
  std::unique_ptr<tiled::TiledFrame> tiled_;  ///< of all frames of filled modes, tiled path
  Framebuffer picture_;
  bool first_picture_ = true;
  RasterCounts counts_;
};

}  // namespace farop
