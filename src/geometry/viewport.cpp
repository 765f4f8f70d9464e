// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/viewport.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace farop {

ScreenFrame Viewport::frame() const {
  return {resolution, subpixel_bits, y_down, half_pixel_border};
}

ViewTangents view_tangents(const Camera& camera, const Viewport& viewport) {
  const double t = std::tan(camera.angle_degrees * (std::numbers::pi / 360));
  const int width = viewport.resolution.x, height = viewport.resolution.y;
  const int border = viewport.pixel_fit == PixelFit::centres ? 1 : 0;
  if (camera.fit == Fit::both || width == border || height == border) return {t, t};
  const double ratio = static_cast<double>(width - border) / (height - border);
  const bool horizontal = camera.fit == Fit::horizontal || (camera.fit == Fit::smaller && width < height);
  return horizontal ? ViewTangents{t, t / ratio} : ViewTangents{t * ratio, t};
}

DeviceMapping::DeviceMapping(const Viewport& viewport, const ViewTangents& tangents, double nearest,
                             double farthest) {
  terms_.nearest = nearest;
  terms_.y_down = viewport.y_down;
  const double unit = std::ldexp(1.0, viewport.subpixel_bits);
  const auto map_axis = [&](int pixels, double tangent, double& scale, double& offset, double& low,
                            double& high) {
    // centres: (n-1)/2 (1 + s);  edges: n/2 (1 + s) - 1/2;  s = x / (z t)
    const bool edges = viewport.pixel_fit == PixelFit::edges;
    const double half_window = unit * (edges ? pixels : pixels - 1) / 2;
    scale = half_window / tangent;
    offset = half_window - (edges ? unit / 2 : 0);
    const double border = viewport.half_pixel_border ? unit / 2 : 0;
    low = -border;
    high = unit * (pixels - 1) + border;
  };
  map_axis(viewport.resolution.x, tangents.x, terms_.scale_x, terms_.offset_x, terms_.low_x, terms_.high_x);
  map_axis(viewport.resolution.y, tangents.y, terms_.scale_y, terms_.offset_y, terms_.low_y, terms_.high_y);
  terms_.depth_scale = std::isinf(farthest) ? 1 : farthest / (farthest - nearest);
  terms_.depth_max = static_cast<double>(viewport.resolution.z - 1);
  terms_.color_max = viewport.resolution.color - 1;
}

ScreenVertex DeviceMapping::to_device(const V3d& position, const Rgb& color) const {
  const Terms& t = terms_;
  const double inverse = 1 / position.z;
  const auto place = [](double v, double low, double high) {
    const double rounded = round_half_up(v);
    return static_cast<std::int32_t>(rounded > low ? std::min(rounded, high) : low);  // NaN becomes low
  };
  const auto shade = [&](double c) {
    return static_cast<std::uint16_t>(place(c * t.color_max, 0, t.color_max));
  };
  ScreenVertex v;
  v.x = place(t.offset_x + t.scale_x * (position.x * inverse), t.low_x, t.high_x);
  v.y = place(t.offset_y + t.scale_y * (position.y * inverse), t.low_y, t.high_y);
  if (t.y_down) v.y = static_cast<std::int32_t>(t.low_y + t.high_y) - v.y;
  v.z = place(t.depth_scale * (1 - t.nearest * inverse) * t.depth_max, 0, t.depth_max);
  v.r = shade(color.r);
  v.g = shade(color.g);
  v.b = shade(color.b);
  return v;
}

}  // namespace farop
