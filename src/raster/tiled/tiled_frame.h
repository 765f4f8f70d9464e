// SPDX-License-Identifier: GPL-3.0-or-later
// The fast path of the internal rasterizer: polygons wait, sorted into tiles, until the frame ends; then
// every tile is cleared, drawn, finished and written to the picture while it is in the cache, tiles in
// parallel.
//
// Same picture, bit for bit, as the plain path (PolygonFiller over the whole frame): same coverage, same
// planes, same order of drawing within every tile.
// On vectors: triangles and fans of them (all convex polygons), opaque. In Phong frames, and where something
//          is transparent in a tile, samples hold the number of the nearest opaque triangle, and values are
//          found once visibility is known.
// One sample at a time, by PolygonFiller within the tile: transparent polygons, those without a fan, and
//          triangles that are no plane triangles.
// Memory:  RasterTuning::waiting_bytes of waiting triangles, 68 bytes each and tile (in Phong frames 60 to 72
// a
//          corner more), and one batch more; in frames of more than 2^26 samples a byte a sample, 2 GB at
//          most. Some 200 KB a thread. When triangles take more, tiles are drawn as far as they are known and
//          kept: 20 bytes a sample, Phong 36 (48 with textures), and 32 a transparent fragment. Transparent
//          fragments otherwise count for the tiles being drawn alone.
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
  std::size_t add_some(const ScreenPolygonBatch& batch, std::size_t next);
  void start_portions();
  void draw_waiting(Framebuffer* picture);
  bool is_empty(int number) const;
  bool has_transparent(int number) const;
  void write_background(int number, Framebuffer& picture) const;
  void begin_tile(Tile& tile, int number, bool numbered) const;
  void draw_tile(Tile& tile, bool numbered) const;
  void find_values(Tile& tile) const;
  void write_tile(Tile& tile, bool numbered, Framebuffer& picture) const;

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
