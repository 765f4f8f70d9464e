// SPDX-License-Identifier: GPL-3.0-or-later
// The fast path of the internal rasterizer: polygons wait, sorted into tiles, until the frame ends; then
// every tile is cleared, drawn, finished and written to the picture while it is in the cache, tiles in
// parallel.
//
// Same picture, bit for bit, as the plain path (PolygonFiller over the whole frame): same coverage, same
// planes, same order of drawing within every tile.
// On vectors: triangles and fans of them (all convex polygons), set up in every tile that they meet. Other
//          polygons, and triangles that are no plane triangles, are cut into spans once, when they are
//          sorted; each tile fills the pieces that lie in it. Both opaque and transparent.
// Numbers: where something is transparent in a tile, and in frames whose tiles are kept, samples also hold
// the
//          number of the nearest opaque surface: its colour before rounding is found once visibility is
//          known. Transparent surfaces leave number and depth at every sample where nothing opaque hides them
//          yet; what is still seen at the end is composited.
// Phong:   samples hold numbers; normals and positions are found once visibility is known. Transparent
// polygons,
//          those without a fan and triangles that are no plane triangles are drawn one sample at a time, by
//          PolygonFiller within every tile.
// Memory:  RasterTuning::waiting_bytes of what waits: 68 bytes a triangle and tile, 120 a span and 8 a piece
// of
//          it (in Phong frames 60 to 72 a corner more), and one batch, or one row of tiles of a polygon in
//          spans, more; in frames of more than 2^26 samples a byte a sample, 2 GB at most. Some 200 KB a
//          thread. When what waits takes more, tiles are drawn as far as they are known and kept: 20 bytes a
//          sample, Phong 36 (48 with textures), and 32 a transparent fragment. Transparent fragments
//          otherwise count for the tiles being drawn alone.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/framebuffer.h"
#include "core/screen_polygon.h"
#include "raster/raster_tuning.h"
#include "raster/tiled/grid.h"
#include "raster/tiled/portion.h"
#include "shading/light.h"

namespace farop::tiled {

struct Tile;

/// What a frame is drawn with; see InternalRasterizerOptions. `background` has 8 bits a channel, red lowest.
struct FrameLook {
  DrawMode mode = DrawMode::gouraud;
  int samples = 1;
  std::uint32_t background = 0;
  Transparency transparency = Transparency::over;
  const ShadingFrame* shading = nullptr;
};

/// Frames one after another: start, add any number of times, finish. Memory is kept for the next frame.
class TiledFrame {
 public:
  explicit TiledFrame(const RasterTuning& tuning);
  ~TiledFrame();
  TiledFrame(const TiledFrame&) = delete;
  TiledFrame& operator=(const TiledFrame&) = delete;

  void start(const ScreenFrame& frame, const FrameLook& look);
  /// Materials and shaders are used until finish().
  void add(const ScreenPolygonBatch& batch);
  /// Draws into a picture of the right size; into its depth too, unless that is empty.
  void finish(Framebuffer& picture);

 private:
  class Workers;

  std::size_t waiting_bytes() const;
  Progress add_some(const ScreenPolygonBatch& batch, const Progress& next);
  void start_portions();
  void draw_waiting(Framebuffer* picture);
  bool is_empty(int number) const;
  bool has_transparent(int number) const;
  void write_background(int number, Framebuffer& picture) const;
  void begin_tile(Tile& tile, int number, Words meaning) const;
  void draw_tile(Tile& tile) const;
  void take_pending(Tile& tile) const;
  void find_values(Tile& tile) const;
  void find_phong_values(Tile& tile) const;
  void composite(Tile& tile) const;
  void write_tile(Tile& tile, Framebuffer& picture) const;

  RasterTuning tuning_;
  ScreenFrame frame_;
  FrameLook look_;
  TileGrid grid_;
  std::size_t room_ = 0;                            ///< bytes of waiting triangles
  std::vector<std::unique_ptr<Portion>> portions_;  ///< one for every thread that sorts
  std::uint32_t batches_ = 0;                       ///< of the frame, so far
  std::vector<std::unique_ptr<Tile>> drawn_;  ///< by number, when part of the frame had to be drawn early
  std::unique_ptr<Workers> workers_;
};

}  // namespace farop::tiled
