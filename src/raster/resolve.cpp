// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/resolve.h"

#include <algorithm>
#include <array>

#include "raster/polygon_filler.h"

namespace farop {
namespace {

/// Finished colour of a sample, 0..255 per channel, not rounded.
Rgb sample_color(SampleBuffer& buffer, std::size_t index, Transparency transparency,
                 const ShadingFrame& shading, RasterCounts& counts) {
  V3f color = buffer.values[index];
  if (!buffer.points.empty() && buffer.points[index].material != 0) {
    const SurfacePoint& point = buffer.points[index];
    const V3d texture = buffer.textures.empty() ? V3d(0, 0, 0) : V3d(buffer.textures[index]);
    color = lit_fragment(buffer.materials[point.material], shading, V3d(point.position), V3d(color), texture)
                .color;
    ++counts.reflections;
  }
  const Rgb opaque{color.x, color.y, color.z};
  if (!buffer.fragments.any_at(index)) return opaque;
  return buffer.fragments.composite(index, buffer.depths[index], opaque, transparency);
}

/// Means of blocks of samples; color(index) gives a finished sample, 0..255 per channel.
template <class ColorOf>
void average(const SampleBuffer& buffer, int degree, Framebuffer& picture, const ColorOf& color_of) {
  const Window& w = buffer.window;
  const int block = degree * degree;
  for (int y = w.y / degree; y < w.end_y / degree; ++y) {
    for (int x = w.x / degree; x < w.end_x / degree; ++x) {
      const std::size_t pixel = picture.pixel(x, y);
      if (degree == 1) {  // nothing to average
        const std::size_t index = buffer.index(x, y);
        const std::array<std::uint8_t, 3> c = color_of(index);
        std::copy(c.begin(), c.end(), &picture.rgb[3 * pixel]);
        if (!picture.depth.empty()) picture.depth[pixel] = static_cast<float>(buffer.depths[index]);
        continue;
      }
      std::array<int, 3> sum{};
      std::int32_t nearest = buffer.empty_depth;
      for (int sy = y * degree; sy < (y + 1) * degree; ++sy) {
        for (int sx = x * degree; sx < (x + 1) * degree; ++sx) {
          const std::size_t index = buffer.index(sx, sy);
          const std::array<std::uint8_t, 3> c = color_of(index);
          sum[0] += c[0], sum[1] += c[1], sum[2] += c[2];
          nearest = std::min(nearest, buffer.depths[index]);
        }
      }
      for (std::size_t c = 0; c < 3; ++c) {
        picture.rgb[3 * pixel + c] = static_cast<std::uint8_t>((2 * sum[c] + block) / (2 * block));
      }
      if (!picture.depth.empty()) picture.depth[pixel] = static_cast<float>(nearest);
    }
  }
}

}  // namespace

void resolve(SampleBuffer& buffer, int degree, Transparency transparency, const ShadingFrame& shading,
             RasterCounts& counts, Framebuffer& picture) {
  average(buffer, degree, picture, [&](std::size_t index) {
    const Rgb c = sample_color(buffer, index, transparency, shading, counts);
    return std::array{to_byte(c.r), to_byte(c.g), to_byte(c.b)};
  });
}

void resolve_words(const SampleBuffer& buffer, int degree, Framebuffer& picture) {
  average(buffer, degree, picture, [&](std::size_t index) {
    const std::uint32_t word = buffer.words[index];
    return std::array{static_cast<std::uint8_t>(word), static_cast<std::uint8_t>(word >> 8),
                      static_cast<std::uint8_t>(word >> 16)};
  });
}

}  // namespace farop
