// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame, or a tile of one, remembers of every sample while polygons are drawn.
#pragma once

#include <tbb/cache_aligned_allocator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/math.h"
#include "raster/edge_table.h"
#include "raster/fragment_store.h"

namespace farop {

struct Material;
class Shader;

/// What lights a surface.
struct SurfaceLook {
  const Material* material = nullptr;
  const Shader* shader = nullptr;  ///< nullptr: the material's reflection model

  /// Nothing behind the surface can be seen.
  bool is_opaque() const;
  /// Nothing of the surface can be seen.
  bool is_invisible() const;
  friend bool operator==(const SurfaceLook&, const SurfaceLook&) = default;
};

/// Numbers for the materials of a frame, so that a sample needs 4 bytes for its own. 0 = nullptr.
class MaterialTable {
 public:
  /// A material always comes with the same shader: both belong to one surface.
  std::uint32_t number(const SurfaceLook& look);
  const SurfaceLook& operator[](std::uint32_t number) const { return looks_[number]; }

 private:
  std::vector<SurfaceLook> looks_{{}};
  std::unordered_map<const Material*, std::uint32_t> numbers_{{nullptr, 0}};
  const Material* last_ = nullptr;  ///< polygons of one surface come in a row
  std::uint32_t last_number_ = 0;
};

/// Phong: what else the reflection model needs once visibility is known.
struct SurfacePoint {
  V3f position{0, 0, 0};       ///< eye space
  std::uint32_t material = 0;  ///< 0: the sample's value is a colour
};

/// What SampleBuffer::words and ::numbers hold of a sample. words: the nearest opaque colour, red in the low
/// byte. numbers: that of the nearest opaque surface, whose values the other arrays get later, k_valued where
/// they hold them already, k_background where there is nothing opaque.
enum class Words : std::uint8_t { none, colors, numbers, both };
constexpr std::uint32_t k_valued = 0xFFFFFFFFu, k_background = 0xFFFFFFFEu;

template <class T>
using SampleArray = std::vector<T, tbb::cache_aligned_allocator<T>>;

/// The samples of a window of the frame, row by row from the bottom.
struct SampleBuffer {
  Window window;
  int stride = 0;                ///< samples from row to row
  std::int32_t empty_depth = 0;  ///< beyond every legal depth: nothing opaque here yet
  SampleArray<std::int32_t> depths;
  /// Colour of the nearest opaque surface, 0..255 per channel, not rounded, so that what lies in front can be
  /// blended exactly. In a Phong frame, where the sample's SurfacePoint has a material: the interpolated
  /// normal, any length, eye space, lit later. Empty where `words` hold colours.
  SampleArray<V3f> values;
  std::vector<SurfacePoint> points;  ///< in Phong frames, else empty
  std::vector<V3f> textures;         ///< in Phong frames, once a shader wanted texture coordinates
  FragmentStore fragments;           ///< transparent ones
  MaterialTable materials;
  Words meaning = Words::none;  ///< other than none in tiles only
  SampleArray<std::uint32_t> words, numbers;

  int width() const { return window.end_x - window.x; }
  int height() const { return window.end_y - window.y; }
  std::size_t count() const { return static_cast<std::size_t>(stride) * static_cast<std::size_t>(height()); }
  /// Of column x and row y of the frame.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - window.y) * static_cast<std::size_t>(stride) +
           static_cast<std::size_t>(x - window.x);
  }
  /// A new nearest opaque surface.
  void put(std::size_t sample, std::int32_t depth, const V3f& value);
};

/// 0..255 rounded to nearest, halves upwards; what lies outside is limited.
inline std::uint8_t to_byte(double component) {
  if (!(component > 0)) return 0;
  const double shifted = component + 0.5;  // positive: truncation is the floor of round_half_up()
  return static_cast<std::uint8_t>(std::min(shifted, 255.0));
}

inline std::uint32_t to_word(const V3f& color) {
  return to_byte(color.x) | std::uint32_t{to_byte(color.y)} << 8 | std::uint32_t{to_byte(color.z)} << 16;
}

inline void SampleBuffer::put(std::size_t sample, std::int32_t depth, const V3f& value) {
  depths[sample] = depth;
  if (meaning == Words::colors || meaning == Words::both) words[sample] = to_word(value);
  if (meaning == Words::colors) return;
  values[sample] = value;
  if (meaning != Words::none) numbers[sample] = k_valued;
}

}  // namespace farop
