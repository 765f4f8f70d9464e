// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame remembers of every sample while polygons are drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/math.h"
#include "raster/fragment_store.h"

namespace farop {

struct Material;
class Shader;

/// What lights a surface.
struct SurfaceLook {
  const Material* material = nullptr;
  const Shader* shader = nullptr;  ///< nullptr: the material's reflection model
};

/// Numbers for the materials of a frame, so that a sample needs 4 bytes for its own. 0 = nullptr.
class MaterialTable {
 public:
  /// A material always comes with the same shader: both belong to one surface.
  std::uint32_t number(const Material* material, const Shader* shader);
  const SurfaceLook& operator[](std::uint32_t number) const { return looks_[number]; }

 private:
  std::vector<SurfaceLook> looks_{{}};
  std::unordered_map<const Material*, std::uint32_t> numbers_{{nullptr, 0}};
  const Material* last_ = nullptr;  ///< polygons of one surface come in a row
  std::uint32_t last_number_ = 0;
};

/// The nearest opaque surface at a sample. Depth and colour share a cache line: both are written together.
struct Sample {
  /// Colour, 0..255 per channel, not rounded, so that what lies in front can be blended exactly. In a Phong
  /// frame, where the sample's SurfacePoint has a material: the interpolated normal, any length, eye space,
  /// lit later.
  V3f value{0, 0, 0};
  std::int32_t depth = 0;
};

/// Phong: what else the reflection model needs once visibility is known.
struct SurfacePoint {
  V3f position{0, 0, 0};       ///< eye space
  std::uint32_t material = 0;  ///< 0: Sample::value is a colour
};

/// Row by row from the bottom, width * height each.
struct SampleBuffer {
  int width = 0, height = 0;
  std::int32_t empty_depth = 0;  ///< beyond every legal depth: nothing opaque here yet
  std::vector<Sample> samples;
  std::vector<SurfacePoint> points;  ///< in Phong frames, else empty
  std::vector<V3f> textures;         ///< in Phong frames, once a shader wanted texture coordinates
  FragmentStore fragments;           ///< transparent ones
  MaterialTable materials;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

}  // namespace farop
