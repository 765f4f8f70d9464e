// SPDX-License-Identifier: GPL-3.0-or-later
// Lighting of arrays of points by whatever a surface is lit with.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/batched/kernels.h"
#include "shading/shader.h"

namespace farop::batched {

/// Points in eye space, and what became of them; arrays as in kernels.h.
struct LitArrays {
  PointArrays points, normals;
  std::uint32_t *red_green, *blue;  ///< device colours: red | green << 16, blue
};

class Lighting {
 public:
  /// Both must outlive it.
  Lighting(const ShadingFrame& frame, const DeviceMapping& mapping);

  /// shade() for n points, without a shader.
  void by_material(const Material& material, std::size_t n, const LitArrays& arrays);

  /// shade() for n points, one by one. `texture(i)` gives texture coordinates, `opacity(i, o)` takes
  /// opacities.
  template <class Texture, class Opacity>
  void by_shader(const Shader& shader, std::size_t n, const LitArrays& arrays, const Texture& texture,
                 const Opacity& opacity) const {
    for (std::size_t i = 0; i < n; ++i) {
      const V3d position(arrays.points.x[i], arrays.points.y[i], arrays.points.z[i]);
      const V3d normal(arrays.normals.x[i], arrays.normals.y[i], arrays.normals.z[i]);
      const Shaded shaded = shader.shade({position, normal, texture(i), -position.normalized()}, frame_);
      const ScreenVertex v = mapping_.to_device(position, shaded.color);
      arrays.red_green[i] = v.r | static_cast<std::uint32_t>(v.g) << 16;
      arrays.blue[i] = v.b;
      opacity(i, shaded.opacity);
    }
  }

 private:
  void take(const Material& material);
  void prepare(std::size_t n, const PointArrays& points);

  /// Points whose lights are prepared together.
  static constexpr std::size_t k_block = 64;
  /// What illuminate() says for the points of a block.
  struct alignas(k_alignment) Prepared {
    double to_x[k_block], to_y[k_block], to_z[k_block], fraction[k_block];
  };

  const ShadingFrame& frame_;
  const DeviceMapping& mapping_;
  const Material* material_ = nullptr;  ///< that reflection_ and rows_ are of
  Reflection reflection_;
  std::vector<LightRow> rows_;
  std::vector<Prepared> prepared_;  ///< one for every row of kind prepared
};

}  // namespace farop::batched
