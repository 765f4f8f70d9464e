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
  const Sample& sample = buffer.samples[index];
  V3f color = sample.value;
  if (!buffer.points.empty() && buffer.points[index].material != 0) {
    const SurfacePoint& point = buffer.points[index];
    const V3d texture = buffer.textures.empty() ? V3d(0, 0, 0) : V3d(buffer.textures[index]);
    color = lit_fragment(buffer.materials[point.material], shading, V3d(point.position), V3d(sample.value),
                         texture)
                .color;
    ++counts.reflections;
  }
  const Rgb opaque{color.x, color.y, color.z};
  if (!buffer.fragments.any_at(index)) return opaque;
  return buffer.fragments.composite(index, sample.depth, opaque, transparency);
}

}  // namespace

std::uint8_t to_byte(double component) {
  if (!(component > 0)) return 0;
  const double shifted = component + 0.5;  // positive: truncation is the floor of round_half_up()
  return static_cast<std::uint8_t>(std::min(shifted, 255.0));
}

Framebuffer resolve(SampleBuffer& buffer, int degree, bool keep_depth, Transparency transparency,
                    const ShadingFrame& shading, RasterCounts& counts) {
  Framebuffer picture;
  picture.width = buffer.width / degree, picture.height = buffer.height / degree;
  const std::size_t pixels = picture.pixel(0, picture.height);
  picture.rgb.resize(3 * pixels);
  if (keep_depth) picture.depth.resize(pixels);
  const int block = degree * degree;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      std::array<int, 3> sum{};
      std::int32_t nearest = buffer.empty_depth;
      for (int sy = y * degree; sy < (y + 1) * degree; ++sy) {
        for (int sx = x * degree; sx < (x + 1) * degree; ++sx) {
          const std::size_t index = buffer.index(sx, sy);
          const Rgb c = sample_color(buffer, index, transparency, shading, counts);
          sum[0] += to_byte(c.r), sum[1] += to_byte(c.g), sum[2] += to_byte(c.b);
          nearest = std::min(nearest, buffer.samples[index].depth);
        }
      }
      const std::size_t pixel = picture.pixel(x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        picture.rgb[3 * pixel + c] = static_cast<std::uint8_t>((2 * sum[c] + block) / (2 * block));
      }
      if (keep_depth) picture.depth[pixel] = static_cast<float>(nearest);
    }
  }
  return picture;
}

}  // namespace farop
