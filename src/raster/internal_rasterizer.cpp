// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/internal_rasterizer.h"

#include <fmt/format.h>
#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <array>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/limits.h"
#include "raster/line.h"
#include "raster/polygon_filler.h"
#include "raster/resolve.h"
#include "raster/sample_buffer.h"
#include "raster/tiled/tiled_frame.h"

namespace farop {
namespace {

[[noreturn]] void broken_contract(const std::string& what) {
  throw Error(ExitStatus::internal, "internal rasterizer: " + what);
}

/// Runs `work`; running out of memory becomes an Error that says for what.
template <class Work>
void with_memory(const ScreenFrame& frame, Work&& work) {
  const auto fail = [&] {
    throw Error(ExitStatus::surroundings,
                fmt::format("not enough memory to draw a frame of {} x {} samples", frame.resolution.x,
                            frame.resolution.y),
                "use a smaller --resolution or fewer --samples");
  };
  try {
    std::forward<Work>(work)();
  } catch (const std::bad_alloc&) {
    fail();
  } catch (const std::length_error&) {
    fail();
  }
}

void check(const ScreenFrame& frame, int samples) {
  const Resolution& r = frame.resolution;
  if (frame.y_down) broken_contract("y must grow upwards");
  if (samples < 1 || samples > k_max_samples) broken_contract(fmt::format("{} samples", samples));
  const int limit = samples * k_max_resolution;
  if (r.x < 1 || r.y < 1 || r.x > limit || r.y > limit || r.x % samples != 0 || r.y % samples != 0 ||
      r.z < k_min_depth_resolution || r.z > k_max_depth_resolution || r.color < k_min_color_resolution ||
      r.color > k_max_color_resolution || frame.subpixel_bits < 0 ||
      frame.subpixel_bits > k_max_subpixel_bits) {
    broken_contract(fmt::format("frame {} {} {} {}, {} sub-pixel bits, {} samples", r.x, r.y, r.z, r.color,
                                frame.subpixel_bits, samples));
  }
}

std::array<std::uint8_t, 3> to_bytes(const Rgb& c) {
  return {to_byte(255 * c.r), to_byte(255 * c.g), to_byte(255 * c.b)};
}

/// Resizes an empty array. Memory that is `fresh` is asked for at once: page by page, when it is first
/// touched, takes as long as drawing a picture of moderate size. What an earlier picture had is there
/// already, and asking again takes a tenth of a small frame.
template <class T>
void resize_new(std::vector<T>& array, std::size_t size, [[maybe_unused]] bool fresh) {
  array.reserve(size);
#ifdef MADV_POPULATE_WRITE
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto first = (reinterpret_cast<std::uintptr_t>(array.data()) + page - 1) / page * page;
  const auto end = reinterpret_cast<std::uintptr_t>(array.data() + size) / page * page;
  if (fresh && first < end)
    madvise(reinterpret_cast<void*>(first), end - first, MADV_POPULATE_WRITE);  // a wish, no more
#endif
  array.resize(size);
}

/// White, or black on a bright background.
std::array<std::uint8_t, 3> line_color(const Rgb& background) {
  const double luminance = 0.2126 * background.r + 0.7152 * background.g + 0.0722 * background.b;
  return luminance > 0.5 ? std::array<std::uint8_t, 3>{0, 0, 0} : std::array<std::uint8_t, 3>{255, 255, 255};
}

/// Nearest whole pixel, halves upwards; the outer ends of a half-pixel border belong to the outermost pixels.
std::int64_t whole_pixel(std::int32_t v, const ScreenFrame& frame, int size) {
  const std::int64_t half = (std::int64_t{1} << frame.subpixel_bits) >> 1;
  const std::int64_t pixel = (v + half) >> frame.subpixel_bits;
  return frame.half_pixel_border && pixel == size ? size - 1 : pixel;
}

}  // namespace

/// Samples, and what draws into them.
struct InternalRasterizer::FilledFrame {
  FilledFrame(const ScreenFrame& frame, const InternalRasterizerOptions& options, RasterCounts& counts)
      : buffer(make_buffer(frame, options)), filler(frame, buffer, options.shading, counts) {}

  static SampleBuffer make_buffer(const ScreenFrame& frame, const InternalRasterizerOptions& options) {
    SampleBuffer b;
    b.window = {0, 0, frame.resolution.x, frame.resolution.y};
    b.stride = frame.resolution.x;
    b.empty_depth = static_cast<std::int32_t>(frame.resolution.z);
    const auto [red, green, blue] = to_bytes(options.background);
    b.depths.assign(b.count(), b.empty_depth);
    b.values.assign(b.count(), V3f(red, green, blue));
    if (options.mode == DrawMode::phong) b.points.resize(b.count());
    return b;
  }

  SampleBuffer buffer;
  PolygonFiller filler;
};

InternalRasterizer::InternalRasterizer(InternalRasterizerOptions options) : options_(std::move(options)) {
  options_.background = clamp01(options_.background);
  if (options_.mode == DrawMode::line) options_.samples = 1;
}

InternalRasterizer::~InternalRasterizer() = default;

void InternalRasterizer::begin_frame(const ScreenFrame& frame) {
  check(frame, options_.samples);
  frame_ = frame;
  filled_.reset();
  picture_ = {};
  counts_ = {};
  with_memory(frame_, [&] {
    const Transparency transparency =
        options_.additive_transparency ? Transparency::additive : Transparency::over;
    const std::array<std::uint8_t, 3> background = to_bytes(options_.background);
    if (options_.mode == DrawMode::line) {
      make_picture();
      for (std::size_t i = 0; i < picture_.rgb.size(); ++i) picture_.rgb[i] = background[i % 3];
      std::fill(picture_.depth.begin(), picture_.depth.end(), static_cast<float>(frame_.resolution.z));
    } else if (options_.tuning.path == RasterPath::plain) {
      filled_ = std::make_unique<FilledFrame>(frame_, options_, counts_);
    } else {
      make_picture();
      if (!tiled_) tiled_ = std::make_unique<tiled::TiledFrame>(options_.tuning);
      const std::uint32_t word =
          background[0] | std::uint32_t{background[1]} << 8 | std::uint32_t{background[2]} << 16;
      tiled_->start(frame_, {options_.mode, options_.samples, word, transparency, &options_.shading});
    }
  });
  in_frame_ = true;
}

void InternalRasterizer::make_picture() {
  picture_.width = frame_.resolution.x / options_.samples;
  picture_.height = frame_.resolution.y / options_.samples;
  const std::size_t pixels = picture_.pixel(0, picture_.height);
  resize_new(picture_.rgb, 3 * pixels, first_picture_);
  if (options_.keep_depth) resize_new(picture_.depth, pixels, first_picture_);
  first_picture_ = false;
}

void InternalRasterizer::polygons(const ScreenPolygonBatch& batch) {
  if (!in_frame_) broken_contract("polygons outside a frame");
  for (const ScreenPolygonRecord& polygon : batch.polygons) {
    if (std::size_t{polygon.first_vertex} + polygon.vertex_count > batch.vertices.size()) {
      broken_contract("a polygon reaches beyond the vertices of its batch");
    }
  }
  if (options_.mode == DrawMode::phong && (batch.normals.size() != batch.vertices.size() ||
                                           batch.eye_positions.size() != batch.vertices.size())) {
    broken_contract("normals or eye positions missing");
  }
  counts_.polygons += batch.polygons.size();
  if (options_.mode == DrawMode::line) {
    draw_lines(batch);
  } else if (filled_) {
    with_memory(frame_, [&] { draw_filled(batch); });
  } else {
    with_memory(frame_, [&] { tiled_->add(batch); });
  }
}

void InternalRasterizer::draw_lines(const ScreenPolygonBatch& batch) {
  const std::array<std::uint8_t, 3> color = line_color(options_.background);
  const auto pixel = [&](const ScreenVertex& v) {
    return PixelPosition{whole_pixel(v.x, frame_, picture_.width), whole_pixel(v.y, frame_, picture_.height)};
  };
  for (const ScreenPolygonRecord& polygon : batch.polygons) {
    const std::span<const ScreenVertex> corners = batch.corners(polygon);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      draw_line(picture_, pixel(corners[i]), pixel(corners[i + 1 < corners.size() ? i + 1 : 0]), color);
    }
  }
}

void InternalRasterizer::draw_filled(const ScreenPolygonBatch& batch) {
  const bool phong = options_.mode == DrawMode::phong;
  for (const ScreenPolygonRecord& record : batch.polygons) {
    FillPolygon polygon{batch.corners(record), {}, {}, {}, {}, {record.material, record.shader}};
    const auto corners_of = [&](const std::vector<V3f>& attribute) {
      return std::span(attribute).subspan(record.first_vertex, record.vertex_count);
    };
    if (options_.mode == DrawMode::flat) {
      flat_corners_.assign(polygon.corners.begin(), polygon.corners.end());
      for (ScreenVertex& v : flat_corners_) {
        v.r = flat_corners_.front().r, v.g = flat_corners_.front().g, v.b = flat_corners_.front().b;
      }
      polygon.corners = flat_corners_;
    }
    if (phong) {
      polygon.normals = corners_of(batch.normals);
      polygon.eye_positions = corners_of(batch.eye_positions);
      if (!batch.textures.empty()) polygon.textures = corners_of(batch.textures);
    }
    if (!batch.opacities.empty()) polygon.opacities = corners_of(batch.opacities);
    filled_->filler.fill(polygon);
  }
}

void InternalRasterizer::end_frame() {
  if (!in_frame_) broken_contract("end of a frame that was not begun");
  in_frame_ = false;
  if (options_.mode == DrawMode::line) return;
  if (!filled_) {
    with_memory(frame_, [&] { tiled_->finish(picture_); });
    return;
  }
  with_memory(frame_, [&] {
    make_picture();
    resolve(filled_->buffer, options_.samples,
            options_.additive_transparency ? Transparency::additive : Transparency::over, options_.shading,
            counts_, picture_);
  });
  filled_.reset();
}

Framebuffer InternalRasterizer::take() {
  if (in_frame_ || picture_.rgb.empty()) broken_contract("there is no finished picture to take");
  return std::exchange(picture_, {});
}

}  // namespace farop
