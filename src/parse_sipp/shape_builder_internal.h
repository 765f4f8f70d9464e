// SPDX-License-Identifier: GPL-3.0-or-later
// What the files with primitives share.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <numbers>

#include "core/error.h"
#include "parse_sipp/sipp_shapes.h"
#include "parse_sipp/sipp_surface_builder.h"

namespace farop::sipp {

constexpr double k_pi = std::numbers::pi;

/// Builds an object surface by surface.
class ShapeBuilder {
 public:
  /// Throws Error(ExitStatus::input) when the shape would have more polygons than `look` allows.
  ShapeBuilder(const char* shape, double polygons, const ShapeLook& look) : look_(look) {
    if (polygons <= static_cast<double>(look.max_polygons)) return;
    throw Error(ExitStatus::input,
                fmt::format("a {} of {:.0f} polygons is more than the limit of {}", shape, polygons,
                            look.max_polygons),
                "give a smaller resolution");
  }

  /// The mapping is one of the three that number surfaces in two dimensions.
  bool two_dimensional() const { return look_.texture != TextureMapping::world; }

  /// `texture` counts for two-dimensional mappings; otherwise it is the position.
  void push(const V3d& position, const V3d& texture) {
    builder_.push_vertex({position, two_dimensional() ? texture : position, {}});
  }
  struct Corner {
    V3d position, texture;
  };
  void polygon(std::initializer_list<Corner> corners) {
    for (const Corner& corner : corners) push(corner.position, corner.texture);
    builder_.push_polygon();
  }
  void end_polygon() { builder_.push_polygon(); }
  void end_surface() {
    if (auto surface = builder_.create(look_.shader)) object_->surfaces.push_back(std::move(surface));
  }
  std::shared_ptr<Object> take() { return std::move(object_); }

 private:
  const ShapeLook& look_;
  SurfaceBuilder builder_;
  std::shared_ptr<Object> object_ = std::make_shared<Object>();
};

inline bool all_finite(std::initializer_list<double> numbers) {
  for (const double v : numbers) {
    if (!std::isfinite(v)) return false;
  }
  return true;
}

/// Angle of elevation of `height` at `distance` as a fraction of the half circle: 0 straight down, 1 straight
/// up.
inline double elevation(double height, double distance) {
  return height == 0 && distance == 0 ? 0.5 : std::atan(height / distance) / k_pi + 0.5;
}

}  // namespace farop::sipp
