// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/tiled/bins.h"

namespace farop::tiled {

TriangleBlock* BlockPool::take() {
  if (used_ == slabs_.size() * k_slab) slabs_.push_back(std::make_unique<TriangleBlock[]>(k_slab));
  TriangleBlock* const block = &slabs_[used_ / k_slab][used_ % k_slab];
  ++used_;
  return block;
}

void BlockPool::shrink(std::size_t bytes) {
  const std::size_t slabs = bytes / (k_slab * sizeof(TriangleBlock));
  if (used_ == 0 && slabs_.size() > slabs) slabs_.resize(slabs);
}

void Bin::grow(BlockPool& pool) {
  TriangleBlock* const block = pool.take();
  block->next = nullptr;
  (last == nullptr ? first : last->next) = block;
  last = block;
  in_last = 0;
}

}  // namespace farop::tiled
