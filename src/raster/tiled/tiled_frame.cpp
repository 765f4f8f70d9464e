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
#include <limits>
#include <optional>

#include "core/task_order.h"
#include "raster/corner_color.h"
#include "raster/perspective.h"
#include "raster/resolve.h"
#include "raster/tiled/kernels.h"
#include "raster/tiled/numbered_values.h"
#include "shading/shader.h"

namespace farop::tiled {
namespace {

/// Polygons that are worth sorting in parallel.
constexpr std::size_t k_parallel_polygons = 512;
/// Corners of polygons that are sorted alone: their spans may have to be drawn in parts.
constexpr std::uint32_t k_many_corners = 4096;

/// Samples from which on a frame may have a byte of waiting triangles each: an entry a tile alone takes a
/// quarter of that, and to keep all tiles would take twenty times as much.
constexpr std::int64_t k_large_frame = std::int64_t{1} << 26, k_most_room = std::int64_t{1} << 31;

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
  PendingFragments pending;
  std::optional<PolygonFiller> filler;        ///< once something special was drawn
  std::vector<const TriangleEntry*> entries;  ///< by number
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
    TaskOrder order;
    const auto in_order = [&](int i) {
      order.begin();
      work(i);
      order.end();
    };
    order.before_all();
    arena_.execute([&] { tbb::parallel_for(0, count, in_order, tbb::simple_partitioner()); });
    order.after_all();
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
  const std::int64_t samples = std::int64_t{frame.resolution.x} * frame.resolution.y;
  const bool large = samples > k_large_frame;
  const int side = large ? k_tile : std::clamp(tuning_.tile_size, 8, k_tile);
  grid_ = TileGrid(frame, std::max(side / look.samples, 1) * look.samples);
  room_ = tuning_.waiting_bytes;
  if (large) room_ = std::max(room_, static_cast<std::size_t>(std::min(samples, k_most_room)));
  drawn_.clear();
  start_portions();
}

void TiledFrame::start_portions() {
  const auto count = static_cast<std::size_t>(std::min(workers_->threads(), k_max_bins));
  while (portions_.size() < count) portions_.push_back(std::make_unique<Portion>());
  for (std::size_t i = 0; i < count; ++i) {
    portions_[i]->start(grid_, look_.mode, frame_.resolution.color, static_cast<std::uint32_t>(i));
  }
  batches_ = 0;
}

std::size_t TiledFrame::waiting_bytes() const {
  std::size_t bytes = 0;
  for (const std::unique_ptr<Portion>& portion : portions_) bytes += portion->bytes();
  return bytes;
}

void TiledFrame::add(const ScreenPolygonBatch& batch) {
  const std::size_t count = batch.polygons.size();
  for (Progress next; next.polygon < count;) {
    next = add_some(batch, next);
    if (waiting_bytes() > room_) draw_waiting(nullptr);
  }
}

// Takes polygons from `next` on until all are taken or there is no room for more; returns how far it came.
Progress TiledFrame::add_some(const ScreenPolygonBatch& batch, const Progress& next) {
  constexpr std::size_t k_no_limit = std::numeric_limits<std::size_t>::max();
  const std::size_t left = batch.polygons.size() - next.polygon, shares = portions_.size();
  const std::uint32_t number = batches_++;
  // In parallel as many as cannot take more than half of the memory, whatever they cover.
  const std::size_t safe = room_ / 2 / (sizeof(TriangleEntry) * static_cast<std::size_t>(grid_.count()));
  std::size_t taken = std::min(left, safe);
  if (shares > 1 && taken >= k_parallel_polygons) {
    const auto first = batch.polygons.begin() + static_cast<std::ptrdiff_t>(next.polygon);
    const auto has_many = [](const ScreenPolygonRecord& p) { return p.vertex_count > k_many_corners; };
    taken = static_cast<std::size_t>(
        std::find_if(first, first + static_cast<std::ptrdiff_t>(taken), has_many) - first);
  }
  if (shares == 1 || taken < k_parallel_polygons) {
    const std::size_t others = waiting_bytes() - portions_[0]->bytes();
    const std::size_t room = room_ - std::min(others, room_);
    const std::size_t end = next.polygon + (taken < std::min(left, safe) ? taken + 1 : left);
    return portions_[0]->add(batch, number, next, end, {room, k_no_limit});
  }
  const std::size_t share = (taken + shares - 1) / shares;
  workers_->run(static_cast<int>(shares), false, [&](int k) {
    const std::size_t first = std::min(static_cast<std::size_t>(k) * share, taken);
    const std::size_t end = std::min(first + share, taken);
    portions_[static_cast<std::size_t>(k)]->add(batch, number, {next.polygon + first, 0}, next.polygon + end,
                                                {k_no_limit, room_ / shares});
  });
  return {next.polygon + taken, 0};
}

void TiledFrame::draw_waiting(Framebuffer* picture) {
  bool shaders = false;
  for (const std::unique_ptr<Portion>& portion : portions_) {
    shaders = shaders || portion->has_shaders();
  }
  const bool early = picture == nullptr;
  if (early && drawn_.empty()) drawn_.resize(static_cast<std::size_t>(grid_.count()));
  const bool alone = shaders && look_.mode == DrawMode::phong;  // shaders want to be called from one thread
  workers_->run(grid_.count(), alone, [&](int number) {
    const bool empty = is_empty(number);
    if (empty && (drawn_.empty() || drawn_[static_cast<std::size_t>(number)] == nullptr)) {
      if (!early) write_background(number, *picture);
      return;
    }
    const bool numbered = look_.mode == DrawMode::phong || !drawn_.empty();
    const Words meaning = numbered ? Words::numbers : has_transparent(number) ? Words::both : Words::colors;
    Tile* tile = &workers_->tile();
    bool begun = false;
    if (!drawn_.empty()) {
      std::unique_ptr<Tile>& slot = drawn_[static_cast<std::size_t>(number)];
      begun = slot != nullptr;
      if (!begun) slot = std::make_unique<Tile>();
      tile = slot.get();
    }
    if (!begun) begin_tile(*tile, number, meaning);
    if (!empty) draw_tile(*tile);
    if (!early) write_tile(*tile, *picture);
  });
  if (early) start_portions();
}

bool TiledFrame::is_empty(int number) const {
  for (const std::unique_ptr<Portion>& portion : portions_) {
    if (portion->bin(number).size != 0) return false;
  }
  return true;
}

bool TiledFrame::has_transparent(int number) const {
  for (const std::unique_ptr<Portion>& portion : portions_) {
    if (portion->bin(number).has_transparent) return true;
  }
  return false;
}

void TiledFrame::write_background(int number, Framebuffer& picture) const {
  const Window w = grid_.window(number);
  const int first = w.x / look_.samples, end = w.end_x / look_.samples;
  std::array<std::uint32_t, k_tile> words;
  words.fill(look_.background);
  for (int y = w.y / look_.samples; y < w.end_y / look_.samples; ++y) {
    const std::size_t pixel = picture.pixel(first, y);
    words_to_rgb(words.data(), end - first, &picture.rgb[3 * pixel]);
    if (picture.depth.empty()) continue;
    std::fill_n(&picture.depth[pixel], end - first, static_cast<float>(frame_.resolution.z));
  }
}

void TiledFrame::finish(Framebuffer& picture) {
  draw_waiting(&picture);
  drawn_.clear();
}

void TiledFrame::begin_tile(Tile& tile, int number, Words meaning) const {
  constexpr std::size_t k_samples = k_tile * k_tile + k_tile_padding;
  SampleBuffer& b = tile.buffer;
  b.window = grid_.window(number);
  b.stride = k_tile;
  b.empty_depth = static_cast<std::int32_t>(frame_.resolution.z);
  b.depths.resize(k_samples);
  b.meaning = meaning;
  if (meaning != Words::numbers) b.words.resize(k_samples);
  if (meaning != Words::colors) b.numbers.resize(k_samples);
  if (meaning == Words::both) b.values.resize(k_samples);
  b.fragments.clear();
  b.materials = {};
  b.textures.clear();
  if (meaning == Words::numbers) {
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
  task.depth = b.depths.data(), task.far = tile.far.data();
  task.word = meaning != Words::numbers ? b.words.data() : nullptr;
  task.number = meaning != Words::colors ? b.numbers.data() : nullptr;
  task.fragments = &tile.pending;
  clear_tile(task, look_.background, meaning == Words::numbers ? k_valued : k_background);
}

void TiledFrame::draw_tile(Tile& tile) const {
  struct Special {
    Tile& tile;
    const TiledFrame& frame;
  } special{tile, *this};
  tile.task.context = &special;
  tile.task.special = [](void* context, const TriangleEntry& entry) {
    auto& [t, frame] = *static_cast<Special*>(context);
    frame.take_pending(t);  // fragments are numbered in drawing order
    if (!t.filler) t.filler.emplace(frame.frame_, t.buffer, *frame.look_.shading, t.counts);
    t.filler->fill(frame.portions_[entry.portion]->kept()[entry.source]);
  };
  const int number = grid_.tile_of[static_cast<std::size_t>(tile.buffer.window.y)] * grid_.columns +
                     grid_.tile_of[static_cast<std::size_t>(tile.buffer.window.x)];
  std::array<const Bin*, k_max_bins> bins{};
  std::size_t size = 0;
  for (std::size_t i = 0; i < portions_.size(); ++i) {
    bins[i] = &portions_[i]->bin(number);
    tile.task.spans[i] = &portions_[i]->spans();
    size += bins[i]->size;
  }
  if (tile.task.number != nullptr) tile.entries.resize(size);
  tile.task.entries = tile.entries.data();
  draw_bins(tile.task, bins.data(), static_cast<int>(portions_.size()));
  take_pending(tile);
  if (look_.mode == DrawMode::phong) {
    find_phong_values(tile);
  } else if (tile.buffer.meaning == Words::numbers) {
    find_values(tile);
  } else if (tile.buffer.meaning == Words::both) {
    composite(tile);
  }
}

// Keeps what is not behind an opaque surface by now.
void TiledFrame::take_pending(Tile& tile) const {
  SampleBuffer& b = tile.buffer;
  NumberedValues values(portions_, tile.entries, frame_.subpixel_bits);
  for (const PendingFragment& f : tile.pending.all()) {
    if (f.depth >= b.depths[f.sample]) continue;
    const int x = b.window.x + static_cast<int>(f.sample % k_tile);
    const int y = b.window.y + static_cast<int>(f.sample / k_tile);
    b.fragments.add(f.sample, b.depths.size(), f.depth, values.color(f.number, x, y),
                    values.opacity(f.number, x, y));
  }
  tile.pending.clear();
}

// Replaces numbers of surfaces by what the surfaces have at the samples.
void TiledFrame::find_values(Tile& tile) const {
  SampleBuffer& b = tile.buffer;
  NumberedValues values(portions_, tile.entries, frame_.subpixel_bits);
  for (int y = b.window.y; y < b.window.end_y; ++y) {
    for (int x = b.window.x; x < b.window.end_x; ++x) {
      const std::size_t sample = b.index(x, y);
      if (b.numbers[sample] == k_valued) continue;
      b.values[sample] = values.color(b.numbers[sample], x, y);
      b.numbers[sample] = k_valued;
    }
  }
}

// Colours of samples where something transparent is seen.
void TiledFrame::composite(Tile& tile) const {
  SampleBuffer& b = tile.buffer;
  if (!b.fragments.any()) return;
  NumberedValues values(portions_, tile.entries, frame_.subpixel_bits);
  for (int y = b.window.y; y < b.window.end_y; ++y) {
    for (int x = b.window.x; x < b.window.end_x; ++x) {
      const std::size_t sample = b.index(x, y);
      if (!b.fragments.any_at(sample)) continue;
      const std::uint32_t number = b.numbers[sample];
      V3f behind = color_of(look_.background);
      if (number == k_valued) {
        behind = b.values[sample];
      } else if (number != k_background) {
        behind = values.color(number, x, y);
      }
      const Rgb color =
          b.fragments.composite(sample, b.depths[sample], {behind.x, behind.y, behind.z}, look_.transparency);
      b.words[sample] =
          to_byte(color.r) | std::uint32_t{to_byte(color.g)} << 8 | std::uint32_t{to_byte(color.b)} << 16;
    }
  }
}

// The same in Phong frames.
void TiledFrame::find_phong_values(Tile& tile) const {
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
      const std::uint32_t number = b.numbers[sample];
      if (number == k_valued) continue;
      if (number != last) {
        last = number;
        const TriangleEntry& e = *tile.entries[number];
        kept = &portions_[e.portion]->kept();
        t.a = {e.x[0], e.y[0], e.z[0]};
        t.b = {e.x[1], e.y[1], e.z[1]};
        t.c = {e.x[2], e.y[2], e.z[2]};
        polygon = (*kept)[e.source];
        look_number = b.materials.number(polygon.look);
        ScreenVertex* const vertices[3] = {&t.a, &t.b, &t.c};
        for (std::size_t k = 0; k < 3; ++k) {
          ScreenVertex& v = *vertices[k];
          corners[k] = e.color[k] - kept->polygons[e.source].first;
          const ScreenVertex& c = polygon.corners[corners[k]];
          const int resolution = frame_.resolution.color;
          v.r = to_8_bits(c.r, resolution), v.g = to_8_bits(c.g, resolution);
          v.b = to_8_bits(c.b, resolution);
        }
        planes.reset();
        if (polygon.look.material == nullptr) {
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
      b.numbers[sample] = k_valued;
      if (planes) {
        b.values[sample] = planes->color(x, y);
        b.points[sample].material = look_number;
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

void TiledFrame::write_tile(Tile& tile, Framebuffer& picture) const {
  SampleBuffer& b = tile.buffer;
  if (b.meaning == Words::numbers) {
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
