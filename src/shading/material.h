// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/color.h"

namespace farop {

/// Surface of a polygon before lighting. Coefficients as in NFF's `f`.
struct Material {
  Rgb color{1, 1, 1};
  double ka = 0.30;  ///< ambient; NFF has none, the 1997 system's log shows this one
  double kd = 1;
  double ks = 0;
  double shine = 0;          ///< exponent n of (R.V)^n, >= 0
  double transmittance = 0;  ///< as read: opacity is 1 - T clamped to [0,1], equal in all channels
  double refraction = 1;     ///< index; carried along, not used

  Rgb opacity() const;
  bool opaque() const { return transmittance <= 0; }
  friend bool operator==(const Material&, const Material&) = default;
};

}  // namespace farop
