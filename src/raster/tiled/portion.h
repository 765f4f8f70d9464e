// SPDX-License-Identifier: GPL-3.0-or-later
// Some polygons of a frame in drawing order, sorted into tiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/draw_mode.h"
#include "core/screen_polygon.h"
#include "raster/polygon_filler.h"
#include "raster/tiled/bins.h"
#include "raster/tiled/grid.h"
#include "raster/tiled/kept_spans.h"
#include "raster/tiled/span_sorter.h"

namespace farop::tiled {

/// A polygon of which more is remembered than its triangles in the bins: corners as they came, and what runs
/// parallel to them.
struct KeptPolygon {
  std::uint32_t first = 0,
                count = 0;  ///< in KeptPolygons::corners and, in Phong frames, the arrays beside it
  std::uint32_t first_texture = k_no_vertex_id, first_opacity = k_no_vertex_id;
  SurfaceLook look;
};

struct KeptPolygons {
  std::vector<KeptPolygon> polygons;
  std::vector<ScreenVertex> corners;
  std::vector<V3f> normals, eye_positions, textures, opacities;

  FillPolygon operator[](std::uint32_t number) const;
  std::size_t bytes() const;
  void clear();
};

/// What a triangle has beside its place.
struct TrianglePayload {
  std::uint32_t color[3] = {0, 0, 0};
  std::uint32_t source = 0;
  std::uint16_t transparent = 0;
};

/// How far a batch has been taken.
struct Progress {
  std::size_t polygon = 0;  ///< the first that was not, or not all of it,
  int row = 0;              ///< from this row of the frame on
};

/// Bytes that may be in use.
struct PortionLimits {
  std::size_t all = 0;    ///< adding stops when there are more
  std::size_t spans = 0;  ///< polygons whose spans might take more are not cut into tiles
};

/// Filled by one thread, read by all when tiles are drawn.
class Portion {
 public:
  /// Empty, for a new frame or after what it had was drawn. `color_resolution` is the frame's.
  void start(const TileGrid& grid, DrawMode mode, int color_resolution, std::uint32_t number);
  /// Takes polygons `first` .. `end` - 1 of the frame's batch `number` until a limit is reached; returns how
  /// far it came.
  Progress add(const ScreenPolygonBatch& batch, std::uint32_t number, Progress first, std::size_t end,
               const PortionLimits& limits);

  const Bin& bin(int tile) const { return bins_[static_cast<std::size_t>(tile)]; }
  const KeptPolygons& kept() const { return kept_; }
  const KeptSpans& spans() const { return spans_; }
  std::size_t bytes() const { return pool_.used_bytes() + kept_bytes_ + spans_.bytes(); }
  bool has_shaders() const { return has_shaders_; }

 private:
  struct Samples {
    int first_column, end_column, first_row, end_row;
    bool empty() const { return first_column >= end_column || first_row >= end_row; }
  };

  bool add_simple_triangle(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record);
  int add_polygon(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record, int first_row);
  void add_entry(Bin& bin, const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c,
                 const TrianglePayload& payload);
  void add_to_tiles(const Triangle& t, const TrianglePayload& payload, const Samples& samples);
  void add_to_tiles_of_rows(const Triangle& t, const TrianglePayload& payload, const Samples& samples);
  void add_triangle(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record, const Triangle& t,
                    TrianglePayload payload, const std::uint32_t (&numbers)[3]);
  int add_by_scan_lines(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record,
                        std::span<const std::uint32_t> numbers, int first_row, std::size_t byte_limit);
  void add_special(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record,
                   std::span<const std::uint32_t> numbers, const Samples& samples);
  TriangleEntry& add_other(Bin& bin, std::int32_t kind);
  std::span<const std::uint32_t> all_corners(std::size_t count);
  void load_corners(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record,
                    std::span<const std::uint32_t> numbers);
  std::uint32_t keep(const ScreenPolygonBatch& batch, const ScreenPolygonRecord& record,
                     std::span<const std::uint32_t> numbers);
  Samples samples_of(std::int32_t low_x, std::int32_t high_x, std::int32_t low_y, std::int32_t high_y) const;
  Samples samples_of(const Triangle& t) const;
  template <class Add>
  void for_each_tile(const Samples& samples, const Add& add);
  std::uint32_t color_word(const ScreenVertex& v) const;

  const TileGrid* grid_ = nullptr;
  DrawMode mode_ = DrawMode::gouraud;
  int color_resolution_ = 256;
  BlockPool pool_;
  std::vector<Bin> bins_;
  KeptPolygons kept_;
  std::size_t kept_bytes_ = 0;
  KeptSpans spans_;
  SpanSorter span_sorter_;
  PortionLimits limits_;
  std::uint32_t number_ = 0, batch_ = 0;
  bool has_shaders_ = false;
  SurfaceLook last_look_;  ///< polygons of a surface come in a row
  bool last_opaque_ = true, last_invisible_ = false;
  std::vector<std::uint32_t> all_corners_;  ///< 0, 1, 2 ...
  // Of add_to_tiles_of_rows(): rows of tiles walked through so far, and by column the last that got an entry.
  std::uint64_t tile_rows_ = 0;
  std::vector<std::uint64_t> last_row_;
  // Of the polygon that is cut into spans.
  std::vector<ScreenVertex> corners_;
  std::vector<V3d> opacities_;
};

}  // namespace farop::tiled
