// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/fragment_store.h"

#include <algorithm>
#include <stdexcept>

#include "raster/sample_buffer.h"
#include "shading/material.h"

namespace farop {

void FragmentStore::add(std::size_t sample, std::size_t samples, std::int32_t depth, const V3f& color,
                        std::uint32_t material) {
  if (newest_.empty()) newest_.assign(samples, k_none);
  if (fragments_.size() >= k_none) throw std::length_error("too many transparent fragments");
  fragments_.push_back({color, depth, material, newest_[sample]});
  newest_[sample] = static_cast<std::uint32_t>(fragments_.size() - 1);
}

Rgb FragmentStore::composite(std::size_t sample, std::int32_t opaque_depth, Rgb behind,
                             const MaterialTable& materials) {
  order_.clear();
  for (std::uint32_t f = newest_[sample]; f != k_none; f = fragments_[f].older) {
    if (fragments_[f].depth < opaque_depth) order_.emplace_back(fragments_[f].depth, f);
  }
  // Fragments are numbered in drawing order, which decides among equal depths.
  std::sort(order_.begin(), order_.end());
  Rgb sum;
  Rgb let_through{1, 1, 1};
  for (const auto& [depth, f] : order_) {
    const Fragment& fragment = fragments_[f];
    const Rgb o = materials[fragment.material]->opacity();
    sum += let_through * o * Rgb{fragment.color.x, fragment.color.y, fragment.color.z};
    let_through = let_through * Rgb{1 - o.r, 1 - o.g, 1 - o.b};
  }
  return sum + let_through * behind;
}

}  // namespace farop
