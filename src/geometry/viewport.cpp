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
                             double farthest)
    : nearest_(nearest), y_down_(viewport.y_down) {
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
  map_axis(viewport.resolution.x, tangents.x, scale_x_, offset_x_, low_x_, high_x_);
  map_axis(viewport.resolution.y, tangents.y, scale_y_, offset_y_, low_y_, high_y_);
  depth_scale_ = std::isinf(farthest) ? 1 : farthest / (farthest - nearest);
  depth_max_ = static_cast<double>(viewport.resolution.z - 1);
  color_max_ = viewport.resolution.color - 1;
}

ScreenVertex DeviceMapping::to_device(const V3d& position, const Rgb& color) const {
  const double inverse = 1 / position.z;
  const auto place = [](double v, double low, double high) {
    const double rounded = round_half_up(v);
    return static_cast<std::int32_t>(rounded > low ? std::min(rounded, high) : low);  // NaN becomes low
  };
  const auto shade = [&](double c) {
    return static_cast<std::uint16_t>(place(c * color_max_, 0, color_max_));
  };
  ScreenVertex v;
  v.x = place(offset_x_ + scale_x_ * (position.x * inverse), low_x_, high_x_);
  v.y = place(offset_y_ + scale_y_ * (position.y * inverse), low_y_, high_y_);
  if (y_down_) v.y = static_cast<std::int32_t>(low_y_ + high_y_) - v.y;
  v.z = place(depth_scale_ * (1 - nearest_ * inverse) * depth_max_, 0, depth_max_);
  v.r = shade(color.r);
  v.g = shade(color.g);
  v.b = shade(color.b);
  return v;
}

}  // namespace farop
