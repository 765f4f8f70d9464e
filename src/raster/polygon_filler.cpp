// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/polygon_filler.h"

#include <algorithm>

#include "raster/corner_color.h"
#include "raster/perspective.h"
#include "raster/ramp.h"
#include "shading/shade.h"

namespace farop {

LitFragment lit_fragment(const SurfaceLook& look, const ShadingFrame& shading, const V3d& position,
                         const V3d& normal, const V3d& texture) {
  const Shaded lit = shade(look.shader, *look.material, position, normal.normalized(), texture, shading);
  return {V3f(to_vector(clamp01(lit.color)) * 255.0), V3f(to_vector(clamp01(lit.opacity)))};
}

PolygonFiller::PolygonFiller(const ScreenFrame& frame, SampleBuffer& buffer, const ShadingFrame& shading,
                             RasterCounts& counts)
    : buffer_(buffer),
      shading_(shading),
      counts_(counts),
      edge_table_(buffer.window, frame.subpixel_bits),
      subpixel_bits_(frame.subpixel_bits),
      color_resolution_(frame.resolution.color),
      phong_(!buffer.points.empty()) {}

void PolygonFiller::fill(const FillPolygon& polygon) {
  const SurfaceLook& look = polygon.look;
  if (look.is_invisible()) return;
  opaque_ = look.is_opaque();
  textured_ = phong_ && look.shader != nullptr && look.shader->wants_texture();
  if (textured_ && buffer_.textures.empty()) buffer_.textures.assign(buffer_.count(), V3f(0, 0, 0));
  look_number_ = buffer_.materials.number(look);
  load_attributes(polygon);
  const std::optional<std::uint32_t> center = fan_center(corners_);
  if (!center) {
    set_perspective(attributes_, look);
    fill_by_scan_lines(corners_, look);
    return;
  }
  for (std::uint32_t i = 1; i + 1 < corners_.size(); ++i) {
    if (const auto triangle = fan_triangle(corners_, *center, i)) fill_triangle(*triangle, look);
  }
}

void PolygonFiller::load_attributes(const FillPolygon& polygon) {
  attributes_.resize(polygon.corners.size());
  corners_.assign(polygon.corners.begin(), polygon.corners.end());
  for (std::size_t i = 0; i < attributes_.size(); ++i) {
    ScreenVertex& v = corners_[i];
    Attributes& a = attributes_[i];
    v.r = to_8_bits(v.r, color_resolution_), v.g = to_8_bits(v.g, color_resolution_);
    v.b = to_8_bits(v.b, color_resolution_);
    a.depth = v.z;
    a.color = V3d(v.r, v.g, v.b);
    if (phong_) a.normal = V3d(polygon.normals[i]), a.position = V3d(polygon.eye_positions[i]);
    if (textured_) a.texture = V3d(polygon.textures[i]);
    if (opaque_) continue;
    a.opacity =
        polygon.opacities.empty() ? to_vector(polygon.look.material->opacity()) : V3d(polygon.opacities[i]);
  }
}

// Of the corners of what is filled next: a triangle, or a polygon without a fan.
void PolygonFiller::set_perspective(std::span<Attributes> corners, const SurfaceLook& look) {
  const auto in_front_of_the_eye = [](const Attributes& a) { return a.position.z > 0; };
  perspective_ = phong_ && look.shader != nullptr && std::ranges::all_of(corners, in_front_of_the_eye);
  if (!perspective_) return;
  for (Attributes& a : corners) {
    const Place place = projected({a.position, a.texture});
    a.position = place.position, a.texture = place.texture;
  }
}

PolygonFiller::Attributes PolygonFiller::at(const EdgePoint& point) const {
  const Attributes& a = attributes_[point.bottom];
  const Attributes& b = attributes_[point.top];
  Attributes result;
  result.depth = mix(point, a.depth, b.depth);
  result.color = mix(point, a.color, b.color);
  if (phong_) {
    result.normal = mix(point, a.normal, b.normal), result.position = mix(point, a.position, b.position);
  }
  if (textured_) result.texture = mix(point, a.texture, b.texture);
  if (!opaque_) result.opacity = mix(point, a.opacity, b.opacity);
  return result;
}

/// Values of the samples of a span between the values at its ends.
class PolygonFiller::OnSpan {
 public:
  OnSpan(const Span& span, const Attributes& left, const Attributes& right)
      : span_(span),
        depth_(depth_ramp(left.depth, right.depth, span.width)),
        color_(left.color, right.color, span.width),
        normal_(left.normal, right.normal, span.width),
        position_(left.position, right.position, span.width),
        texture_(left.texture, right.texture, span.width),
        opacity_(left.opacity, right.opacity, span.width) {}

  std::int32_t depth(int x) const { return static_cast<std::int32_t>(depth_.at(span_.distance(x))); }
  V3f color(int x) const { return V3f(color_.at(span_.distance(x))); }
  V3d normal(int x) const { return normal_.at(span_.distance(x)); }
  V3d position(int x) const { return position_.at(span_.distance(x)); }
  V3d texture(int x) const { return texture_.at(span_.distance(x)); }
  V3d opacity(int x) const { return opacity_.at(span_.distance(x)); }

 private:
  const Span& span_;
  Ramp<double> depth_;
  Ramp<V3d> color_, normal_, position_, texture_, opacity_;
};

/// Values of the samples of a row of a plane triangle.
class PolygonFiller::OnPlanes {
 public:
  OnPlanes(const Triangle& triangle, const TrianglePlanes& planes,
           const std::array<const Attributes*, 3>& corners, int bits, int y)
      : triangle_(triangle), planes_(planes), corners_(corners), bits_(bits), y_(y) {}

  std::int32_t depth(int x) const { return planes_.depth(x, y_); }
  V3f color(int x) const { return planes_.color(x, y_); }
  V3d normal(int x) const { return mix(x, &Attributes::normal); }
  V3d position(int x) const { return mix(x, &Attributes::position); }
  V3d texture(int x) const { return mix(x, &Attributes::texture); }
  V3d opacity(int x) const { return mix(x, &Attributes::opacity); }

 private:
  V3d mix(int x, V3d Attributes::*value) const {
    return Barycentric(triangle_, bits_, x, y_)
        .mix(corners_[0]->*value, corners_[1]->*value, corners_[2]->*value);
  }

  const Triangle& triangle_;
  const TrianglePlanes& planes_;
  const std::array<const Attributes*, 3>& corners_;
  int bits_, y_;
};

void PolygonFiller::fill_by_scan_lines(std::span<const ScreenVertex> corners, const SurfaceLook& look) {
  edge_table_.load(corners);
  while (edge_table_.next_row()) {
    for (const Span& span : edge_table_.spans()) {
      fill_span(span, OnSpan(span, at(span.left), at(span.right)), look);
    }
  }
}

void PolygonFiller::fill_triangle(const std::array<std::uint32_t, 3>& numbers, const SurfaceLook& look) {
  const Triangle triangle{corners_[numbers[0]], corners_[numbers[1]], corners_[numbers[2]]};
  const std::array<ScreenVertex, 3> corners = {triangle.a, triangle.b, triangle.c};
  std::array<Attributes, 3> values = {attributes_[numbers[0]], attributes_[numbers[1]],
                                      attributes_[numbers[2]]};
  set_perspective(values, look);
  if (!is_plane_triangle(triangle, subpixel_bits_)) {
    std::vector<Attributes> of_polygon(values.begin(), values.end());
    attributes_.swap(of_polygon);
    fill_by_scan_lines(corners, look);
    attributes_.swap(of_polygon);
    return;
  }
  const std::array<const Attributes*, 3> pointers = {&values[0], &values[1], &values[2]};
  const TrianglePlanes planes(triangle, subpixel_bits_);
  edge_table_.load(corners);
  while (edge_table_.next_row()) {
    for (const Span& span : edge_table_.spans()) {
      fill_span(span, OnPlanes(triangle, planes, pointers, subpixel_bits_, edge_table_.row()), look);
    }
  }
}

template <class Values>
void PolygonFiller::fill_span(const Span& span, const Values& values, const SurfaceLook& look) {
  const int y = edge_table_.row();
  std::uint64_t visible = 0, lit_now = 0, transparent = 0;

  const auto for_each_visible = [&](auto&& draw) {
    for (int x = span.first; x < span.end; ++x) {
      const std::size_t sample = buffer_.index(x, y);
      const std::int32_t z = values.depth(x);
      if (z >= buffer_.depths[sample]) continue;
      ++visible;
      draw(sample, x, z);
    }
  };

  const bool lit_per_pixel = phong_ && look.material != nullptr;
  if (lit_per_pixel) {
    const auto place_at = [&](int x) {
      const Place place{values.position(x), values.texture(x)};
      return perspective_ ? projected(place) : place;
    };
    for_each_visible([&](std::size_t sample, int x, std::int32_t z) {
      const Place place = place_at(x);
      if (!opaque_) {
        const LitFragment lit = lit_fragment(look, shading_, place.position, values.normal(x), place.texture);
        ++lit_now;
        if (lit.opacity.x >= 1 && lit.opacity.y >= 1 && lit.opacity.z >= 1) {
          // Not known before it was lit: it hides what is behind like any opaque sample, but has its colour.
          buffer_.put(sample, z, lit.color);
          buffer_.points[sample].material = 0;
          return;
        }
        buffer_.fragments.add(sample, buffer_.count(), z, lit.color, lit.opacity);
        ++transparent;
        return;
      }
      buffer_.put(sample, z, V3f(values.normal(x)));
      buffer_.points[sample] = {V3f(place.position), look_number_};
      if (textured_) buffer_.textures[sample] = V3f(place.texture);
    });
    counts_.reflections += lit_now;
  } else if (!opaque_) {
    for_each_visible([&](std::size_t sample, int x, std::int32_t z) {
      buffer_.fragments.add(sample, buffer_.count(), z, values.color(x), V3f(values.opacity(x)));
      ++transparent;
    });
  } else {
    for_each_visible([&](std::size_t sample, int x, std::int32_t z) {
      buffer_.put(sample, z, values.color(x));
      if (phong_) buffer_.points[sample].material = look_number_;
    });
  }
  counts_.transparent_fragments += transparent;
  counts_.fragments += static_cast<std::uint64_t>(span.end - span.first);
  counts_.visible_fragments += visible;
}

}  // namespace farop
