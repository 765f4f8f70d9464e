// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/fragment_store.h"

#include <algorithm>
#include <stdexcept>

namespace farop {

void FragmentStore::add(std::size_t sample, std::size_t samples, std::int32_t depth, const V3f& color,
                        const V3f& opacity) {
  if (newest_.empty()) newest_.assign(samples, k_none);
  if (fragments_.size() >= k_none) throw std::length_error("too many transparent fragments");
  fragments_.push_back({color, opacity, depth, newest_[sample]});
  newest_[sample] = static_cast<std::uint32_t>(fragments_.size() - 1);
}

void FragmentStore::clear() {
  newest_.clear();
  fragments_.clear();
}

Rgb FragmentStore::composite(std::size_t sample, std::int32_t opaque_depth, Rgb behind, Transparency rule) {
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
    const V3d o(fragment.opacity);
    const Rgb covered =
        rule == Transparency::over
            ? let_through * Rgb{o.x, o.y, o.z}
            : Rgb{std::min(o.x, let_through.r), std::min(o.y, let_through.g), std::min(o.z, let_through.b)};
    sum += covered * Rgb{fragment.color.x, fragment.color.y, fragment.color.z};
    let_through += covered * -1;
  }
  return sum + let_through * behind;
}

}  // namespace farop
