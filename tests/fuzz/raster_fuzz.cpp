// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target: any vertices in a small frame, all modes. Nothing may be written outside, nothing may
// overflow, and the coverage of every polygon must be that of the reference.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "raster/edge_table.h"
#include "raster/internal_rasterizer.h"
#include "raster/reference.h"
#include "shading/material.h"

namespace {

/// Reads numbers from the front of the input; zeros behind its end.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool empty() const { return size_ == 0; }
  template <class Integer>
  Integer take() {
    Integer value = 0;
    const std::size_t n = size_ < sizeof value ? size_ : sizeof value;
    std::memcpy(&value, data_, n);
    data_ += n, size_ -= n;
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

std::vector<std::uint8_t> spans_of(std::span<const farop::ScreenVertex> corners, int bits, int width,
                                   int height) {
  const auto columns = static_cast<std::size_t>(width);
  std::vector<std::uint8_t> covered(columns * static_cast<std::size_t>(height));
  farop::EdgeTable table(width, height, bits);
  table.load(corners);
  while (table.next_row()) {
    for (const farop::Span& span : table.spans()) {
      for (int x = span.first; x < span.end; ++x)
        ++covered.at(static_cast<std::size_t>(table.row()) * columns + static_cast<std::size_t>(x));
    }
  }
  return covered;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  farop::InternalRasterizerOptions options;
  options.mode = static_cast<farop::DrawMode>(input.take<std::uint8_t>() % 4);
  options.samples = 1 + input.take<std::uint8_t>() % 3;
  options.keep_depth = true;
  options.shading.lights = {{farop::V3d(1, 2, 3), {1, 1, 1}}};
  farop::ScreenFrame frame;
  frame.resolution.x = options.samples * (1 + input.take<std::uint8_t>() % 12);
  frame.resolution.y = options.samples * (1 + input.take<std::uint8_t>() % 12);
  frame.resolution.z = 2 + input.take<std::uint32_t>() % (1u << 30);
  if (frame.resolution.z > 1 << 30) frame.resolution.z = 1 << 30;
  frame.resolution.color = 2 + input.take<std::uint16_t>() % 65535;
  frame.subpixel_bits = input.take<std::uint8_t>() % 9;
  frame.half_pixel_border = input.take<std::uint8_t>() % 2 == 1;

  const std::vector<farop::Material> materials(1,
                                               farop::Material{.ks = 0.5, .shine = 8, .transmittance = 0.5});
  farop::ScreenPolygonBatch batch;
  while (!input.empty() && batch.vertices.size() < 400) {
    farop::ScreenPolygonRecord record;
    record.first_vertex = static_cast<std::uint32_t>(batch.vertices.size());
    record.vertex_count = input.take<std::uint8_t>() % 40;
    record.material = input.take<std::uint8_t>() % 2 == 1 ? &materials[0] : nullptr;
    const int shift = input.take<std::uint8_t>() % 32;  // small coordinates meet the frame
    for (std::uint32_t i = 0; i < record.vertex_count; ++i) {
      farop::ScreenVertex v;
      v.x = input.take<std::int32_t>() >> shift, v.y = input.take<std::int32_t>() >> shift;
      v.z = input.take<std::int32_t>();
      v.r = input.take<std::uint16_t>();
      batch.vertices.push_back(v);
      batch.normals.emplace_back(input.take<std::int8_t>(), input.take<std::int8_t>(),
                                 input.take<std::int8_t>());
      batch.eye_positions.emplace_back(input.take<std::int8_t>(), 0, 4);
    }
    batch.polygons.push_back(record);
    const auto corners = batch.corners(record);
    const int width = frame.resolution.x, height = frame.resolution.y;
    if (spans_of(corners, frame.subpixel_bits, width, height) !=
        farop::reference::coverage(corners, frame.subpixel_bits, width, height)) {
      std::abort();
    }
  }

  farop::InternalRasterizer rasterizer(options);
  rasterizer.begin_frame(frame);
  rasterizer.polygons(batch);
  rasterizer.end_frame();
  const farop::Framebuffer picture = rasterizer.take();
  if (picture.rgb.size() != 3 * picture.depth.size()) std::abort();
  return 0;
}
