// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/plugin_rasterizer.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <new>
#include <random>
#include <span>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/math.h"

namespace farop {
namespace {

std::uint8_t to_byte(double component) {
  return static_cast<std::uint8_t>(round_half_up(255 * component));
}

std::uint8_t* row_of(const farop_frame& frame, int y) {
  return frame.pixels + y * frame.row_bytes;
}

}  // namespace

PolygonWants polygon_wants(const farop_rasterizer& rasterizer) {
  PolygonWants wants;
  wants.triangles = (rasterizer.wants & FAROP_WANT_TRIANGLES) != 0;
  wants.normals = (rasterizer.wants & FAROP_WANT_NORMALS) != 0;
  wants.eye_positions = (rasterizer.wants & FAROP_WANT_EYE_POSITIONS) != 0;
  wants.vertex_ids = (rasterizer.wants & FAROP_WANT_VERTEX_IDS) != 0;
  wants.max_vertices = true;
  return wants;
}

farop_frame plugin_frame(const ScreenFrame& frame, const Rgb& background) {
  farop_frame out{};
  out.struct_size = sizeof out;
  out.width = frame.resolution.x;
  out.height = frame.resolution.y;
  out.subpixel_bits = frame.subpixel_bits;
  out.z_near = 0;
  out.z_far = static_cast<std::int32_t>(frame.resolution.z - 1);
  out.max_vertices = frame.max_vertices;
  const Rgb c = clamp01(background);
  out.background[0] = to_byte(c.r), out.background[1] = to_byte(c.g), out.background[2] = to_byte(c.b);
  return out;
}

void clear_frame(const farop_frame& frame) {
  for (int x = 0; x < frame.width; ++x) std::memcpy(frame.pixels + 3 * x, frame.background, 3);
  for (int y = 1; y < frame.height; ++y) {
    std::memcpy(row_of(frame, y), frame.pixels, 3 * static_cast<std::size_t>(frame.width));
  }
}

Framebuffer average_blocks(const farop_frame& frame, int degree, bool y_down) {
  Framebuffer picture;
  picture.width = frame.width / degree, picture.height = frame.height / degree;
  picture.rgb.resize(3 * picture.pixel(0, picture.height));
  const int block = degree * degree;
  for (int y = 0; y < picture.height; ++y) {
    const int row = y_down ? picture.height - 1 - y : y;
    std::uint8_t* out = &picture.rgb[3 * picture.pixel(0, y)];
    if (degree == 1) {
      std::memcpy(out, row_of(frame, row), 3 * static_cast<std::size_t>(picture.width));
      continue;
    }
    for (int x = 0; x < 3 * picture.width; ++x) {
      int sum = 0;
      for (int sy = row * degree; sy < (row + 1) * degree; ++sy) {
        const std::uint8_t* sample = row_of(frame, sy) + 3 * (x / 3) * degree + x % 3;
        for (int sx = 0; sx < degree; ++sx) sum += sample[3 * sx];
      }
      out[x] = static_cast<std::uint8_t>((2 * sum + block) / (2 * block));
    }
  }
  return picture;
}

PluginRasterizer::PluginRasterizer(const PluginLibrary& library, HostServices& services,
                                   const PluginDrawing& drawing)
    : library_(library),
      services_(services),
      drawing_(drawing),
      table_(library.table),
      chunk_(library.table->wants) {
  if (drawing_.check) {
    checker_.emplace(*library_.table, [this](const ContractFinding& f) { findings_.push_back(f); });
    table_ = &checker_->table();
  }
  create_timer_.trace_to(drawing.trace, "create", TraceTrack::rasterizer);
  begin_timer_.trace_to(drawing.trace, "begin_frame", TraceTrack::rasterizer);
  polygon_timer_.trace_to(drawing.trace, "polygon", TraceTrack::rasterizer);
  end_timer_.trace_to(drawing.trace, "end_frame", TraceTrack::rasterizer);
  if (library_.table->create != nullptr) {
    const TimedSlice slice(create_timer_);
    check(create(), "create");
  } else {
    create();
  }
  created_ = true;
}

farop_status PluginRasterizer::create() {
  if (!checker_) {
    return table_->create == nullptr ? FAROP_OK : table_->create(services_.host(), &self_);
  }
  self_ = checker_->self();
  return checker_->create(services_.host());
}

PluginRasterizer::~PluginRasterizer() {
  if (created_ && table_->destroy != nullptr) table_->destroy(self_);
}

void PluginRasterizer::check(farop_status status, const char* function) const {
  if (status >= 0) return;
  const std::string words = services_.last_words();
  const bool in_polygon = std::string_view(function) == "polygon";
  throw Error(ExitStatus::plugin,
              fmt::format("rasterizer '{}': {}{} failed: {}{}", library_.name, function,
                          in_polygon ? fmt::format(" number {}", std::uint32_t{current_}) : "",
                          status_text(status), words.empty() ? "" : ": " + words));
}

void PluginRasterizer::begin_frame(const ScreenFrame& frame) {
  const std::uint32_t number = frame_.struct_size == 0 ? 0 : frame_.number + 1;
  frame_ = plugin_frame(frame, drawing_.background);
  frame_.number = number;
  y_down_ = frame.y_down;
  frame_.row_bytes = 3 * std::int64_t{frame_.width};
  if (draws_here()) {
    make_room();
    clear_frame(frame_);
  }
  chunk_.begin_frame(frame.resolution.color);
  services_.forget_words();
  const TimedSlice slice(begin_timer_);
  check(table_->begin_frame(self_, &frame_), "begin_frame");
}

// With a checker: something between the rows, and a row before and behind them.
void PluginRasterizer::make_room() {
  if (checker_) frame_.row_bytes = (frame_.row_bytes + 15) / 16 * 16 + 16;
  const auto row = static_cast<std::size_t>(frame_.row_bytes);
  const std::size_t apron = checker_ ? row : 0;
  const std::size_t frame_bytes = row * static_cast<std::size_t>(frame_.height);
  try {
    pixels_.resize(apron + frame_bytes + apron);
  } catch (const std::bad_alloc&) {
    throw Error(ExitStatus::surroundings,
                fmt::format("not enough memory for a frame of {} x {} pixels", frame_.width, frame_.height),
                "use a smaller --resolution or fewer --samples");
  }
  frame_.pixels = pixels_.data() + apron;
  if (!checker_) return;
  std::minstd_rand random(frame_.number + 1);
  for (std::uint8_t& byte : pixels_) byte = static_cast<std::uint8_t>(random() >> 8);
  const std::span<const std::uint8_t> all(pixels_);
  checker_->watch({all.first(apron), all.last(apron)});
}

void PluginRasterizer::polygons(const ScreenPolygonBatch& batch) {
  chunk_.append(batch);
  farop_status status = FAROP_OK;
  {
    const TimedSlice slice(polygon_timer_);
    status = play_chunk(*table_, self_, chunk_.view(), &current_);
  }
  check(status, "polygon");
  chunk_.clear();
}

void PluginRasterizer::end_frame() {
  const TimedSlice slice(end_timer_);
  check(table_->end_frame(self_), "end_frame");
}

PluginTimes PluginRasterizer::times() const {
  return {create_timer_.total(), begin_timer_.total(), polygon_timer_.total(), end_timer_.total()};
}

Framebuffer PluginRasterizer::take() {
  return average_blocks(frame_, drawing_.samples, y_down_);
}

}  // namespace farop
