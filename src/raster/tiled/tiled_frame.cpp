// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/tiled/tiled_frame.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <optional>

#include "raster/corner_color.h"
#include "raster/perspective.h"
#include "raster/resolve.h"
#include "raster/tiled/kernels.h"
#include "shading/shader.h"

namespace farop::tiled {
namespace {

/// Polygons that are worth a task of their own.
constexpr std::size_t k_parallel_batch = 8192;

V3f color_of(std::uint32_t word) {
  return V3f(static_cast<float>(word & 255u), static_cast<float>(word >> 8 & 255u),
             static_cast<float>(word >> 16 & 255u));
}

}  // namespace

/// A tile while it is drawn, and its samples.
struct Tile {
  SampleBuffer buffer;
  SampleArray<std::int32_t> far;
  RasterCounts counts;
  TileTask task;
  std::optional<PolygonFiller> filler;       ///< once something special was drawn
  std::vector<const TriangleBlock*> blocks;  ///< triangle `number` is entry number % k_block of one of them
  std::vector<const KeptPolygons*> kept;     ///< parallel to blocks
};

/// Threads, and a tile for each.
class TiledFrame::Workers {
 public:
  /// More threads than the machine has processors only when asked for.
  explicit Workers(int threads)
      : threads_(threads),
        more_(tbb::global_control::max_allowed_parallelism,
              static_cast<std::size_t>(std::max(threads, tbb::info::default_concurrency()))),
        arena_(threads) {}

  int threads() const { return threads_; }
  Tile& tile() { return tiles_.local(); }

  /// Calls work(0) .. work(count - 1), in any order; or from one thread alone in that order.
  template <class Work>
  void run(int count, bool alone, const Work& work) {
    if (threads_ == 1 || alone || count == 1) {
      for (int i = 0; i < count; ++i) work(i);
      return;
    }
    arena_.execute([&] { tbb::parallel_for(0, count, work, tbb::simple_partitioner()); });
  }

 private:
  int threads_;
  tbb::global_control more_;
  tbb::task_arena arena_;
  tbb::enumerable_thread_specific<Tile> tiles_;
};

TiledFrame::TiledFrame(const RasterTuning& tuning) : tuning_(tuning) {
  const int available = tbb::info::default_concurrency();
  workers_ = std::make_unique<Workers>(tuning.threads > 0 ? std::min(tuning.threads, 1024) : available);
}

TiledFrame::~TiledFrame() = default;

void TiledFrame::start(const ScreenFrame& frame, const FrameLook& look) {
  frame_ = frame, look_ = look;
  const int side = std::clamp(tuning_.tile_size, 8, k_tile);
  grid_ = TileGrid(frame, std::max(side / look.samples, 1) * look.samples);
  in_use_ = 0;
  can_append_ = false;
  drawn_.clear();
}

Portion& TiledFrame::new_portion() {
  if (in_use_ == portions_.size()) portions_.push_back(std::make_unique<Portion>());
  Portion& portion = *portions_[in_use_++];
  portion.start(grid_, look_.mode, frame_.resolution.color);
  return portion;
}

std::size_t TiledFrame::waiting_bytes() const {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < in_use_; ++i) bytes += portions_[i]->bytes();
  return bytes;
}

void TiledFrame::add(const ScreenPolygonBatch& batch) {
  const std::size_t count = batch.polygons.size();
  if (workers_->threads() > 1 && count >= 2 * k_parallel_batch) {
    add_in_parallel(batch);
    return;
  }
  std::size_t next = 0;
  while (next < count) {
    if (!can_append_) new_portion(), can_append_ = true;
    Portion& portion = *portions_[in_use_ - 1];
    const std::size_t others = waiting_bytes() - portion.bytes();
    next = portion.add(batch, next, count, tuning_.waiting_bytes - std::min(others, tuning_.waiting_bytes));
    if (next < count) draw_waiting(nullptr);
  }
}

void TiledFrame::add_in_parallel(const ScreenPolygonBatch& batch) {
  const std::size_t count = batch.polygons.size();
  std::size_t next = 0;
  while (next < count) {
    // Shares of equal size; what a share has no room for is taken up again after drawing.
    const auto shares = std::min<std::size_t>(static_cast<std::size_t>(workers_->threads()),
                                              (count - next + k_parallel_batch - 1) / k_parallel_batch);
    const std::size_t first_portion = in_use_, share = (count - next + shares - 1) / shares;
    const std::size_t waiting = waiting_bytes();
    const std::size_t room = (tuning_.waiting_bytes - std::min(waiting, tuning_.waiting_bytes)) / shares;
    for (std::size_t k = 0; k < shares; ++k) new_portion();
    can_append_ = false;
    std::vector<std::size_t> stopped(shares);
    workers_->run(static_cast<int>(shares), false, [&](int k) {
      const auto number = static_cast<std::size_t>(k);
      const std::size_t first = std::min(next + number * share, count), end = std::min(first + share, count);
      stopped[number] = portions_[first_portion + number]->add(batch, first, end, room);
    });
    for (std::size_t k = 0; k < shares; ++k) {
      const std::size_t end = std::min(next + (k + 1) * share, count);
      if (stopped[k] == end) continue;
      // Later shares must wait until this one is complete: they are taken again.
      in_use_ = first_portion + k + 1;
      draw_waiting(nullptr);
      next = stopped[k];
      break;
    }
    if (in_use_ != 0) next = count;
  }
}

void TiledFrame::draw_waiting(Framebuffer* picture) {
  bool shaders = false, transparent = false;
  for (std::size_t i = 0; i < in_use_; ++i) {
    shaders = shaders || portions_[i]->has_shaders();
    transparent = transparent || portions_[i]->has_transparent();
  }
  const bool early = picture == nullptr;
  const bool numbered = look_.mode == DrawMode::phong || transparent || early || !drawn_.empty();
  if (early && drawn_.empty()) drawn_.resize(static_cast<std::size_t>(grid_.count()));
  const bool alone = shaders && look_.mode == DrawMode::phong;  // shaders want to be called from one thread
  workers_->run(grid_.count(), alone, [&](int number) {
    Tile* tile = &workers_->tile();
    bool begun = false;
    if (!drawn_.empty()) {
      std::unique_ptr<Tile>& slot = drawn_[static_cast<std::size_t>(number)];
      begun = slot != nullptr;
      if (!begun) slot = std::make_unique<Tile>();
      tile = slot.get();
    }
    if (!begun) begin_tile(*tile, number, numbered);
    draw_tile(*tile, numbered);
    if (!early) write_tile(*tile, numbered, *picture);
  });
  in_use_ = 0;
  can_append_ = false;
}

void TiledFrame::finish(Framebuffer& picture) {
  draw_waiting(&picture);
  drawn_.clear();
}

void TiledFrame::begin_tile(Tile& tile, int number, bool numbered) const {
  constexpr std::size_t k_samples = k_tile * k_tile + k_tile_padding;
  SampleBuffer& b = tile.buffer;
  b.window = grid_.window(number);
  b.stride = k_tile;
  b.empty_depth = static_cast<std::int32_t>(frame_.resolution.z);
  b.depths.resize(k_samples);
  b.words.resize(k_samples);
  b.meaning = numbered ? Words::numbers : Words::colors;
  b.fragments = {};
  b.materials = {};
  b.textures.clear();
  if (numbered) {
    b.values.assign(k_samples, color_of(look_.background));
    b.points.clear();
    if (look_.mode == DrawMode::phong) b.points.resize(k_samples);
  }
  tile.far.resize(k_far_blocks * k_far_blocks);
  tile.filler.reset();

  TileTask& task = tile.task;
  task.x = b.window.x, task.y = b.window.y;
  task.width = b.width(), task.height = b.height();
  task.subpixel_bits = frame_.subpixel_bits;
  task.empty_depth = b.empty_depth;
  task.depth = b.depths.data(), task.word = b.words.data(), task.far = tile.far.data();
  task.numbered = numbered;
  clear_tile(task, numbered ? k_valued : look_.background);
}

void TiledFrame::draw_tile(Tile& tile, bool numbered) const {
  struct Special {
    Tile& tile;
    const TiledFrame& frame;
    const KeptPolygons* kept;
  } special{tile, *this, nullptr};
  tile.task.context = &special;
  tile.task.special = [](void* context, std::uint32_t polygon) {
    auto& [t, frame, kept] = *static_cast<Special*>(context);
    if (!t.filler) t.filler.emplace(frame.frame_, t.buffer, *frame.look_.shading, t.counts);
    t.filler->fill((*kept)[polygon]);
  };
  tile.blocks.clear(), tile.kept.clear();
  const int number = grid_.tile_of[static_cast<std::size_t>(tile.buffer.window.y)] * grid_.columns +
                     grid_.tile_of[static_cast<std::size_t>(tile.buffer.window.x)];
  for (std::size_t i = 0; i < in_use_; ++i) {
    const Bin& bin = portions_[i]->bin(number);
    if (bin.first == nullptr) continue;
    special.kept = &portions_[i]->kept();
    draw_bin(tile.task, bin, static_cast<std::uint32_t>(tile.blocks.size()) * k_block);
    if (!numbered) continue;
    for (const TriangleBlock* block = bin.first; block != nullptr; block = block->next) {
      tile.blocks.push_back(block);
      tile.kept.push_back(special.kept);
    }
  }
  if (numbered) find_values(tile);
}

// Replaces numbers of triangles by what the triangles have at the samples.
void TiledFrame::find_values(Tile& tile) const {
  SampleBuffer& b = tile.buffer;
  const int bits = frame_.subpixel_bits;
  std::uint32_t last = k_valued;
  Triangle t;
  std::optional<TrianglePlanes> planes;
  std::array<std::size_t, 3> corners{};
  const KeptPolygons* kept = nullptr;
  FillPolygon polygon;
  std::uint32_t look_number = 0;
  std::array<Place, 3> places;
  bool textured = false, perspective = false;
  for (int y = b.window.y; y < b.window.end_y; ++y) {
    for (int x = b.window.x; x < b.window.end_x; ++x) {
      const std::size_t sample = b.index(x, y);
      const std::uint32_t number = b.words[sample];
      if (number == k_valued) continue;
      if (number != last) {
        last = number;
        const TriangleBlock& block = *tile.blocks[number / k_block];
        const std::uint32_t i = number % k_block;
        kept = tile.kept[number / k_block];
        t.a = {block.x[0][i], block.y[0][i], block.z[0][i]};
        t.b = {block.x[1][i], block.y[1][i], block.z[1][i]};
        t.c = {block.x[2][i], block.y[2][i], block.z[2][i]};
        const bool phong = look_.mode == DrawMode::phong;
        if (phong) {
          polygon = (*kept)[block.source[i]];
          look_number = b.materials.number(polygon.look);
        }
        ScreenVertex* const vertices[3] = {&t.a, &t.b, &t.c};
        for (std::size_t k = 0; k < 3; ++k) {
          ScreenVertex& v = *vertices[k];
          if (phong) {
            corners[k] = block.color[k][i] - kept->polygons[block.source[i]].first;
            const ScreenVertex& c = polygon.corners[corners[k]];
            const int resolution = frame_.resolution.color;
            v.r = to_8_bits(c.r, resolution), v.g = to_8_bits(c.g, resolution);
            v.b = to_8_bits(c.b, resolution);
          } else {
            const std::uint32_t word = block.color[k][i];
            v.r = static_cast<std::uint8_t>(word), v.g = static_cast<std::uint8_t>(word >> 8);
            v.b = static_cast<std::uint8_t>(word >> 16);
          }
        }
        planes.reset();
        if (!phong || polygon.look.material == nullptr) {
          planes.emplace(t, bits);
        } else {
          const Shader* const shader = polygon.look.shader;
          textured = shader != nullptr && shader->wants_texture();
          perspective = shader != nullptr;
          for (std::size_t k = 0; k < 3; ++k) {
            places[k].position = V3d(polygon.eye_positions[corners[k]]);
            places[k].texture = textured ? V3d(polygon.textures[corners[k]]) : V3d(0, 0, 0);
            perspective = perspective && places[k].position.z > 0;
          }
          if (perspective) std::transform(places.begin(), places.end(), places.begin(), projected);
        }
      }
      b.words[sample] = k_valued;
      if (planes) {
        b.values[sample] = planes->color(x, y);
        if (look_.mode == DrawMode::phong) b.points[sample].material = look_number;
        continue;
      }
      const Barycentric where(t, bits, x, y);
      const auto normal = [&](std::size_t k) { return V3d(polygon.normals[corners[k]]); };
      b.values[sample] = V3f(where.mix(normal(0), normal(1), normal(2)));
      Place place{where.mix(places[0].position, places[1].position, places[2].position),
                  where.mix(places[0].texture, places[1].texture, places[2].texture)};
      if (perspective) place = projected(place);
      b.points[sample] = {V3f(place.position), look_number};
      if (!textured) continue;
      if (b.textures.empty()) b.textures.assign(b.count(), V3f(0, 0, 0));
      b.textures[sample] = V3f(place.texture);
    }
  }
}

void TiledFrame::write_tile(Tile& tile, bool numbered, Framebuffer& picture) const {
  SampleBuffer& b = tile.buffer;
  if (numbered) {
    resolve(b, look_.samples, look_.transparency, *look_.shading, tile.counts, picture);
    return;
  }
  const Window& w = b.window;
  if (look_.samples > 1) {
    resolve_words(b, look_.samples, picture);
    return;
  }
  for (int y = w.y; y < w.end_y; ++y) {
    const std::size_t first = b.index(w.x, y), pixel = picture.pixel(w.x, y);
    words_to_rgb(&b.words[first], b.width(), &picture.rgb[3 * pixel]);
    if (picture.depth.empty()) continue;
    for (int x = 0; x < b.width(); ++x) {
      picture.depth[pixel + static_cast<std::size_t>(x)] =
          static_cast<float>(b.depths[first + static_cast<std::size_t>(x)]);
    }
  }
}

}  // namespace farop::tiled
