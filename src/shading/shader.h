// SPDX-License-Identifier: GPL-3.0-or-later
// The interface of shaders other than NFF's reflection model.
#pragma once

#include <string>
#include <vector>

#include "shading/light.h"
#include "shading/material.h"

namespace farop {

/// A point to be shaded. Eye space.
struct ShadingPoint {
  V3d position{0, 0, 0};
  V3d normal{0, 0, 0};   ///< of any length; turned to the lit side
  V3d texture{0, 0, 0};  ///< texture coordinates u v w
  V3d to_eye{0, 0, 0};   ///< unit vector
};

struct Shaded {
  Rgb color;             ///< 0..1 per channel
  Rgb opacity{1, 1, 1};  ///< 1: nothing behind is seen
};

/// Colour and opacity of the points of a surface. Called from one thread at a time unless is_pure().
class Shader {
 public:
  virtual ~Shader() = default;

  virtual Shaded shade(const ShadingPoint& point, const ShadingFrame& frame) const = 0;

  /// Every point of a surface with this shader hides what is behind it.
  virtual bool opaque() const = 0;
  /// Nothing of it can be seen anywhere.
  virtual bool invisible() const { return false; }
  /// The colour follows a pattern that vertices alone miss: only shading per pixel shows it.
  virtual bool is_procedural() const { return false; }
  /// shade() looks at ShadingPoint::texture.
  virtual bool wants_texture() const { return is_procedural(); }
  /// shade() depends on its arguments alone and may be called by several threads at once, for any point any
  /// number of times.
  virtual bool is_pure() const { return false; }
  /// The nearest that NFF's `f` can say. What it cannot is added to `lost`, one phrase each, if that is
  /// given.
  virtual Material approximate(std::vector<std::string>* lost = nullptr) const = 0;
  /// One line: kind and parameters in the order of its command. Equal text means equal shading (but for user
  /// functions, which are told apart by address).
  virtual std::string describe() const = 0;
};

}  // namespace farop
