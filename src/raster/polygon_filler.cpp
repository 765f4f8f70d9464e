// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/polygon_filler.h"

#include <algorithm>

namespace farop {
namespace {

/// An attribute along a span, `distance` columns from its left crossing.
template <class T>
struct Ramp {
  Ramp(const T& left, const T& right, double width) : start(left), slope((right - left) * (1 / width)) {}
  T at(double distance) const { return start + slope * distance; }

  T start, slope;
};

/// Component 0..resolution-1 as 8 bits, rounded to nearest.
double to_8_bits(std::uint16_t component, int resolution) {
  if (resolution == 256) return std::min<double>(component, 255);
  return std::min(round_half_up(255.0 * component / (resolution - 1)), 255.0);
}

}  // namespace

V3f lit_color(const Material& material, std::span<const PointLight> lights_eye, const V3d& position,
              const V3d& normal) {
  const Rgb c = reflect(material, lights_eye, position, normal.normalized(), V3d(0, 0, 0));
  return V3f(V3d(c.r, c.g, c.b) * 255.0);
}

PolygonFiller::PolygonFiller(const ScreenFrame& frame, SampleBuffer& buffer,
                             std::span<const PointLight> lights_eye, RasterCounts& counts)
    : buffer_(buffer),
      lights_eye_(lights_eye),
      counts_(counts),
      edge_table_(buffer.width, buffer.height, frame.subpixel_bits),
      color_resolution_(frame.resolution.color),
      phong_(!buffer.points.empty()) {}

void PolygonFiller::fill(const FillPolygon& polygon) {
  const Material* material = polygon.material;
  if (material != nullptr && material->opacity() == Rgb{0, 0, 0}) return;  // invisible
  edge_table_.load(polygon.corners);
  load_attributes(polygon);
  const std::uint32_t number = buffer_.materials.number(material);
  while (edge_table_.next_row()) {
    for (const Span& span : edge_table_.spans()) fill_span(span, material, number);
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
  }
}

PolygonFiller::Attributes PolygonFiller::at(const EdgePoint& point) const {
  const Attributes& a = attributes_[point.bottom];
  const Attributes& b = attributes_[point.top];
  const auto mix = [&](const auto& from, const auto& to) { return from + (to - from) * point.along; };
  Attributes result;
  result.depth = mix(a.depth, b.depth);
  result.color = mix(a.color, b.color);
  if (phong_) result.normal = mix(a.normal, b.normal), result.position = mix(a.position, b.position);
  return result;
}

void PolygonFiller::fill_span(const Span& span, const Material* material, std::uint32_t material_number) {
  const Attributes left = at(span.left), right = at(span.right);
  const Ramp depth(left.depth + 0.5, right.depth + 0.5, span.width);  // not negative: truncation rounds
  const Ramp color(left.color, right.color, span.width);
  const Ramp normal(left.normal, right.normal, span.width);
  const Ramp position(left.position, right.position, span.width);
  const std::size_t first = buffer_.index(span.first, edge_table_.row());
  const auto count = static_cast<std::size_t>(span.end - span.first);
  std::uint64_t visible = 0;

  const auto for_each_visible = [&](auto&& draw) {
    for (std::size_t i = 0; i < count; ++i) {
      const double distance = span.distance + static_cast<double>(i);
      const auto z = static_cast<std::int32_t>(depth.at(distance));
      if (z >= buffer_.samples[first + i].depth) continue;
      ++visible;
      draw(first + i, distance, z);
    }
  };

  const bool lit_per_pixel = phong_ && material != nullptr;
  if (material != nullptr && !material->opaque()) {
    for_each_visible([&](std::size_t sample, double distance, std::int32_t z) {
      const V3f c = lit_per_pixel
                        ? lit_color(*material, lights_eye_, position.at(distance), normal.at(distance))
                        : V3f(color.at(distance));
      buffer_.fragments.add(sample, buffer_.samples.size(), z, c, material_number);
    });
    counts_.transparent_fragments += visible;
    if (lit_per_pixel) counts_.reflections += visible;
  } else if (phong_) {
    for_each_visible([&](std::size_t sample, double distance, std::int32_t z) {
      buffer_.samples[sample] = {V3f(lit_per_pixel ? normal.at(distance) : color.at(distance)), z};
      buffer_.points[sample] = {V3f(position.at(distance)), material_number};
    });
  } else {
    for_each_visible([&](std::size_t sample, double distance, std::int32_t z) {
      buffer_.samples[sample] = {V3f(color.at(distance)), z};
    });
  }
  counts_.fragments += count;
  counts_.visible_fragments += visible;
}

}  // namespace farop
