// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace farop {

/// Counts of the internal rasterizer over one frame. A fragment is one polygon at one sample.
struct RasterCounts {
  std::uint64_t polygons = 0;
  std::uint64_t fragments = 0;              ///< samples covered, before the depth test
  std::uint64_t visible_fragments = 0;      ///< those nearer than all opaque ones before them
  std::uint64_t transparent_fragments = 0;  ///< part of visible_fragments: kept for compositing
  std::uint64_t reflections = 0;            ///< evaluations of the reflection model (Phong)
};

}  // namespace farop
