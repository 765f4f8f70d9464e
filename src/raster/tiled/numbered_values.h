// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "raster/tiled/kernels.h"
#include "raster/tiled/portion.h"
#include "raster/triangle_planes.h"

namespace farop::tiled {

/// Colours and opacities of surfaces in frames that are not Phong's, by the numbers that drawing leaves at
/// samples. Quick for samples of the same surface one after another.
class NumberedValues {
 public:
  /// `entries`: by number. All must outlive it.
  NumberedValues(const std::vector<std::unique_ptr<Portion>>& portions,
                 const std::vector<const TriangleEntry*>& entries, int subpixel_bits)
      : portions_(portions), entries_(entries), subpixel_bits_(subpixel_bits) {}

  /// 0..255 a channel, not rounded; at a sample of the frame that the surface covers.
  V3f color(std::uint32_t number, int x, int y);
  /// Of a transparent surface.
  V3f opacity(std::uint32_t number, int x, int y);

 private:
  void set(std::uint32_t number);
  void set_triangle(const TriangleEntry& entry);

  const std::vector<std::unique_ptr<Portion>>& portions_;
  const std::vector<const TriangleEntry*>& entries_;
  int subpixel_bits_;
  std::uint32_t number_ = k_valued;  ///< what the rest is about
  const KeptSpan* span_ = nullptr;   ///< instead of a triangle
  const Ramp<V3d>* opacities_ = nullptr;
  Triangle triangle_;
  std::optional<TrianglePlanes> planes_;
  V3d corner_opacities_[3];
  bool one_opacity_ = true;
};

}  // namespace farop::tiled
