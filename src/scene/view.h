// SPDX-License-Identifier: GPL-3.0-or-later
// View parameters as inputs give them, each one present or not, and the camera that results.
#pragma once

#include <optional>

#include "core/color.h"
#include "core/draw_mode.h"
#include "core/math.h"

namespace farop {

/// Which dimension of the picture the angle of view applies to. both: pixels then are not square.
enum class Fit { vertical, horizontal, smaller, both };

/// What one input says; inputs and options override each other member by member.
struct ViewParameters {
  std::optional<V3d> from, at, up;
  std::optional<double> angle;  ///< degrees, full angle, 0 < angle < 180
  std::optional<Fit> fit;
  std::optional<double> hither;   ///< >= 0, along the view direction, scene units
  std::optional<double> yon;      ///< > hither; +infinity is allowed
  std::optional<bool> fit_depth;  ///< see Camera::fit_depth; goes with hither
  struct Size {
    int x = 0, y = 0;
    friend bool operator==(const Size&, const Size&) = default;
  };
  std::optional<Size> resolution;
  std::optional<Rgb> background;

  friend bool operator==(const ViewParameters&, const ViewParameters&) = default;
};

/// How an input wants to be drawn; options override each other as with ViewParameters.
struct DrawingParameters {
  std::optional<DrawMode> mode;
  std::optional<int> samples;     ///< degree of super-sampling, >= 1
  std::optional<bool> two_sided;  ///< faces that point away from the eye are drawn too
  friend bool operator==(const DrawingParameters&, const DrawingParameters&) = default;
};

/// A complete camera. World space is right-handed.
struct Camera {
  V3d from{0, 0, 0}, at{0, 0, -1}, up{0, 1, 0};
  double angle_degrees = 45;
  Fit fit = Fit::vertical;
  double hither = 0;
  std::optional<double> yon;  ///< nothing: `auto`, just beyond the farthest vertex
  /// Integer depths are spread over the range of the vertices wherever that is smaller than hither .. yon;
  /// the planes only clip (SIPP's lie a factor of 10^4 apart).
  bool fit_depth = false;

  /// max(hither, 1e-6 |at - from|): the near plane that clipping and depth mapping use, always positive.
  double near_distance() const;
};

/// Orthonormal eye axes in world space: right, up, and depth along the view direction (left-handed as a
/// triple).
struct EyeAxes {
  V3d right, up, depth;
};
EyeAxes eye_axes(const Camera& camera);

/// True when `up` has no component across the view direction, so that eye_axes() takes a replacement (the
/// world axis least parallel to the view direction).
bool up_is_parallel(const Camera& camera);

/// Row-vector matrix from world to eye space: origin at the eye, x right, y up, z along the view direction.
M44d world_to_eye(const Camera& camera);

}  // namespace farop
