// SPDX-License-Identifier: GPL-3.0-or-later
// Transparent fragments of every sample, kept until the frame ends and all of them are known.
//
// Source: L. Carpenter, "The A-buffer, an Antialiased Hidden Surface Method", SIGGRAPH 1984 (lists per
// pixel); here a fragment always covers its whole sample.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/color.h"
#include "core/math.h"

namespace farop {

/// How fragments of a pixel, taken from near to far, hide what is behind them. over: result = o I + (1 - o)
/// behind. additive: opacities add up until they reach 1 (SIPP 3.1): two layers of 0.5 hide the rest.
enum class Transparency : std::uint8_t { over, additive };

/// Memory: 4 bytes a sample once there is a fragment, and 32 bytes a fragment.
class FragmentStore {
 public:
  /// Adds a fragment in drawing order. `color`: 0..255 per channel, not rounded. `opacity`: 0..1. `samples`:
  /// size of the frame. Throws std::length_error beyond 2^32 - 2 fragments (96 GiB).
  void add(std::size_t sample, std::size_t samples, std::int32_t depth, const V3f& color, const V3f& opacity);

  /// Colour of a sample. Fragments at or behind `opaque_depth` are hidden; of equal depths the first drawn is
  /// in front. `behind`: colour there.
  Rgb composite(std::size_t sample, std::int32_t opaque_depth, Rgb behind, Transparency rule);

  bool any() const { return count_ > 0; }
  /// Keeps the memory.
  void clear();
  bool any_at(std::size_t sample) const { return !newest_.empty() && newest_[sample] != k_none; }

 private:
  static constexpr std::uint32_t k_none = 0xFFFFFFFFu;

  struct Fragment {
    V3f color{0, 0, 0};
    V3f opacity{1, 1, 1};
    std::int32_t depth = 0;
    std::uint32_t older = k_none;  ///< the fragment drawn before at the same sample
  };

  static constexpr std::size_t k_chunk = 256;
  const Fragment& fragment(std::uint32_t number) const { return chunks_[number / k_chunk][number % k_chunk]; }

  std::vector<std::uint32_t> newest_;  ///< per sample
  std::size_t count_ = 0;
  std::vector<std::vector<Fragment>> chunks_;                  ///< grows without moving what it holds
  std::vector<std::pair<std::int32_t, std::uint32_t>> order_;  ///< scratch of composite(): depth, number
};

}  // namespace farop
