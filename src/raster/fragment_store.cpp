// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/fragment_store.h"

#include <algorithm>
#include <stdexcept>

namespace farop {

void FragmentStore::add(std::size_t sample, std::size_t samples, std::int32_t depth, const V3f& color,
                        const V3f& opacity) {
  if (newest_.empty()) newest_.assign(samples, k_none);
  if (count_ >= k_none) throw std::length_error("too many transparent fragments");
  if (count_ == chunks_.size() * k_chunk) chunks_.emplace_back(k_chunk);
  chunks_[count_ / k_chunk][count_ % k_chunk] = {color, opacity, depth, newest_[sample]};
  newest_[sample] = static_cast<std::uint32_t>(count_++);
}

void FragmentStore::clear() {
  newest_.clear();
  count_ = 0;
}

Rgb FragmentStore::composite(std::size_t sample, std::int32_t opaque_depth, Rgb behind, Transparency rule) {
  order_.clear();
  for (std::uint32_t f = newest_[sample]; f != k_none; f = fragment(f).older) {
    if (fragment(f).depth < opaque_depth) order_.emplace_back(fragment(f).depth, f);
  }
  // Fragments are numbered in drawing order, which decides among equal depths.
  if (order_.size() > 1) std::sort(order_.begin(), order_.end());
  Rgb sum;
  Rgb let_through{1, 1, 1};
  for (const auto& [depth, f] : order_) {
    const Fragment& nearest = fragment(f);
    const V3d o(nearest.opacity);
    const Rgb covered =
        rule == Transparency::over
            ? let_through * Rgb{o.x, o.y, o.z}
            : Rgb{std::min(o.x, let_through.r), std::min(o.y, let_through.g), std::min(o.z, let_through.b)};
    sum += covered * Rgb{nearest.color.x, nearest.color.y, nearest.color.z};
    let_through += covered * -1;
  }
  return sum + let_through * behind;
}

}  // namespace farop
