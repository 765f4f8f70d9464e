// SPDX-License-Identifier: GPL-3.0-or-later
// From eye space to integer device coordinates.
//
// Eye space: origin at the camera, x right, y up, z along the view direction (distance in front of the eye).
// Device: column and row in 1/2^subpixel_bits pixel, pixel centres at whole pixels, row 0 at the bottom.
#pragma once

#include "core/math.h"
#include "core/screen_polygon.h"
#include "scene/view.h"

namespace farop {

/// What the frustum's sides go through: the centres of the outermost pixels (NFF's own definition of `angle`,
/// SIPP's too), or the edges of the window (today's renderers).
enum class PixelFit { centres, edges };

/// The picture that the frustum is mapped to.
struct Viewport {
  Resolution resolution;
  PixelFit pixel_fit = PixelFit::centres;
  int subpixel_bits = 0;
  bool y_down = false;             ///< rows count from the top in the numbers handed out
  bool half_pixel_border = false;  ///< see ScreenFrame; only with PixelFit::edges and subpixel_bits > 0

  ScreenFrame frame() const;
};

/// Half width and half height of the window at distance 1.
struct ViewTangents {
  double x = 0, y = 0;
};

/// Square pixels, the angle applied to the dimension that `camera.fit` names (both: no square pixels).
/// t_x / t_y = (XRES-1)/(YRES-1) with PixelFit::centres, XRES/YRES with PixelFit::edges; with centres and a
/// dimension of one pixel both tangents are equal.
ViewTangents view_tangents(const Camera& camera, const Viewport& viewport);

/// Perspective and device mapping of points inside the frustum.
/// Depth is z_s = f (1 - d/z) / (f - d): 0 at d (hither, or the nearest vertex), 1 at f (yon, or the
/// farthest), linear in screen space (A. Watt, "3D Computer Graphics"; Blinn, "Hyperbolic Interpolation",
/// IEEE CG&A 12(4), 1992).
class DeviceMapping {
 public:
  /// The numbers of the mapping: device = offset + scale * x_e / z_e, rounded and limited to low .. high.
  struct Terms {
    double scale_x = 0, offset_x = 0, low_x = 0, high_x = 0;
    double scale_y = 0, offset_y = 0, low_y = 0, high_y = 0;
    double depth_scale = 1, nearest = 0, depth_max = 0;
    double color_max = 0;
    bool y_down = false;
  };

  /// Depths `nearest` .. `farthest` are spread over 0 .. ZRES-1. 0 < nearest < farthest; the latter may be
  /// +infinity.
  DeviceMapping(const Viewport& viewport, const ViewTangents& tangents, double nearest, double farthest);

  /// Rounded by floor(v + 0.5), then clamped to the frame. Asserts nothing: a point outside is clamped like
  /// rounding noise. `color` 0..1 per channel becomes 0..CRES-1. position.z > 0.
  ScreenVertex to_device(const V3d& position, const Rgb& color) const;

  const Terms& terms() const { return terms_; }

 private:
  Terms terms_;
};

}  // namespace farop
