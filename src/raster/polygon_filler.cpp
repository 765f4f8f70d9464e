// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/polygon_filler.h"

#include <algorithm>

#include "shading/shade.h"

namespace farop {
namespace {

/// An attribute along a span, `distance` columns from its left crossing.
template <class T>
struct Ramp {
  Ramp(const T& left, const T& right, double width) : start(left), slope((right - left) * (1 / width)) {}
  T at(double distance) const { return start + slope * distance; }

  T start, slope;
};

/// What a shader asks of a point beside its normal.
struct Place {
  V3d position{0, 0, 0}, texture{0, 0, 0};
};

/// Component 0..resolution-1 as 8 bits, rounded to nearest.
double to_8_bits(std::uint16_t component, int resolution) {
  if (resolution == 256) return std::min<double>(component, 255);
  return std::min(round_half_up(255.0 * component / (resolution - 1)), 255.0);
}

/// Whether nothing behind the polygon can be seen.
bool is_opaque(const SurfaceLook& look) {
  if (look.material == nullptr) return true;
  return look.shader != nullptr ? look.shader->opaque() : look.material->opaque();
}

bool is_invisible(const SurfaceLook& look) {
  if (look.material == nullptr) return false;
  return look.shader != nullptr ? look.shader->invisible() : look.material->opacity() == Rgb{0, 0, 0};
}

bool in_front_of_the_eye(std::span<const V3f> positions) {
  return std::all_of(positions.begin(), positions.end(), [](const V3f& p) { return p.z > 0; });
}

/// x/z, y/z and 1/z are linear on the screen where x, y, z are linear in space; the same function takes them
/// back.
V3d projected(const V3d& p) {
  return {p.x / p.z, p.y / p.z, 1 / p.z};
}

V3d vector(const Rgb& c) {
  return {c.r, c.g, c.b};
}

}  // namespace

LitFragment lit_fragment(const SurfaceLook& look, const ShadingFrame& shading, const V3d& position,
                         const V3d& normal, const V3d& texture) {
  const Shaded lit = shade(look.shader, *look.material, position, normal.normalized(), texture, shading);
  return {V3f(vector(clamp01(lit.color)) * 255.0), V3f(vector(clamp01(lit.opacity)))};
}

PolygonFiller::PolygonFiller(const ScreenFrame& frame, SampleBuffer& buffer, const ShadingFrame& shading,
                             RasterCounts& counts)
    : buffer_(buffer),
      shading_(shading),
      counts_(counts),
      edge_table_(buffer.width, buffer.height, frame.subpixel_bits),
      color_resolution_(frame.resolution.color),
      phong_(!buffer.points.empty()) {}

void PolygonFiller::fill(const FillPolygon& polygon) {
  const SurfaceLook& look = polygon.look;
  if (is_invisible(look)) return;
  opaque_ = is_opaque(look);
  perspective_ = phong_ && look.shader != nullptr && in_front_of_the_eye(polygon.eye_positions);
  textured_ = phong_ && look.shader != nullptr && look.shader->wants_texture();
  if (textured_ && buffer_.textures.empty()) buffer_.textures.assign(buffer_.samples.size(), V3f(0, 0, 0));
  edge_table_.load(polygon.corners);
  load_attributes(polygon);
  const std::uint32_t number = buffer_.materials.number(look.material, look.shader);
  while (edge_table_.next_row()) {
    for (const Span& span : edge_table_.spans()) fill_span(span, look, number);
  }
}

void PolygonFiller::load_attributes(const FillPolygon& polygon) {
  attributes_.resize(polygon.corners.size());
  for (std::size_t i = 0; i < attributes_.size(); ++i) {
    const ScreenVertex& v = polygon.corners[i];
    Attributes& a = attributes_[i];
    a.depth = v.z;
    a.color = {to_8_bits(v.r, color_resolution_), to_8_bits(v.g, color_resolution_),
               to_8_bits(v.b, color_resolution_)};
    if (phong_) a.normal = V3d(polygon.normals[i]), a.position = V3d(polygon.eye_positions[i]);
    if (textured_) a.texture = V3d(polygon.textures[i]);
    if (perspective_) a.position = projected(a.position), a.texture *= a.position.z;
    if (opaque_) continue;
    a.opacity =
        polygon.opacities.empty() ? vector(polygon.look.material->opacity()) : V3d(polygon.opacities[i]);
  }
}

template <class T>
T PolygonFiller::at(const EdgePoint& point, T Attributes::*attribute) const {
  const T& a = attributes_[point.bottom].*attribute;
  const T& b = attributes_[point.top].*attribute;
  return a + (b - a) * point.along;
}

void PolygonFiller::fill_span(const Span& span, const SurfaceLook& look, std::uint32_t look_number) {
  const auto ramp = [&](auto attribute) {
    return Ramp(at(span.left, attribute), at(span.right, attribute), span.width);
  };
  // Not negative: truncation rounds.
  const Ramp depth(at(span.left, &Attributes::depth) + 0.5, at(span.right, &Attributes::depth) + 0.5,
                   span.width);
  const std::size_t first = buffer_.index(span.first, edge_table_.row());
  const auto count = static_cast<std::size_t>(span.end - span.first);
  std::uint64_t visible = 0, lit_now = 0, transparent = 0;

  const auto for_each_visible = [&](auto&& draw) {
    for (std::size_t i = 0; i < count; ++i) {
      const double distance = span.distance + static_cast<double>(i);
      const auto z = static_cast<std::int32_t>(depth.at(distance));
      if (z >= buffer_.samples[first + i].depth) continue;
      ++visible;
      draw(first + i, distance, z);
    }
  };

  const bool lit_per_pixel = phong_ && look.material != nullptr;
  if (lit_per_pixel) {
    const Ramp normal = ramp(&Attributes::normal), position = ramp(&Attributes::position),
               texture = ramp(&Attributes::texture);
    const auto place_at = [&](double distance) {
      Place place{position.at(distance), texture.at(distance)};
      if (perspective_) place.position = projected(place.position), place.texture *= place.position.z;
      return place;
    };
    for_each_visible([&](std::size_t sample, double distance, std::int32_t z) {
      const Place place = place_at(distance);
      if (!opaque_) {
        const LitFragment lit =
            lit_fragment(look, shading_, place.position, normal.at(distance), place.texture);
        ++lit_now;
        if (lit.opacity.x >= 1 && lit.opacity.y >= 1 && lit.opacity.z >= 1) {
          // Not known before it was lit: it hides what is behind like any opaque sample, but has its colour.
          buffer_.samples[sample] = {lit.color, z};
          buffer_.points[sample].material = 0;
          return;
        }
        buffer_.fragments.add(sample, buffer_.samples.size(), z, lit.color, lit.opacity);
        ++transparent;
        return;
      }
      buffer_.samples[sample] = {V3f(normal.at(distance)), z};
      buffer_.points[sample] = {V3f(place.position), look_number};
      if (textured_) buffer_.textures[sample] = V3f(place.texture);
    });
    counts_.reflections += lit_now;
  } else if (!opaque_) {
    const Ramp color = ramp(&Attributes::color), opacity = ramp(&Attributes::opacity);
    for_each_visible([&](std::size_t sample, double distance, std::int32_t z) {
      buffer_.fragments.add(sample, buffer_.samples.size(), z, V3f(color.at(distance)),
                            V3f(opacity.at(distance)));
      ++transparent;
    });
  } else {
    const Ramp color = ramp(&Attributes::color);
    for_each_visible([&](std::size_t sample, double distance, std::int32_t z) {
      buffer_.samples[sample] = {V3f(color.at(distance)), z};
      if (phong_) buffer_.points[sample].material = look_number;
    });
  }
  counts_.transparent_fragments += transparent;
  counts_.fragments += count;
  counts_.visible_fragments += visible;
}

}  // namespace farop
