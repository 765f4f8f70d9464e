// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/tiled/bins.h"

namespace farop::tiled {

EntryBlock* BlockPool::take() {
  const std::size_t bytes = slab_ == 0 ? k_first_slab_bytes : k_slab_bytes;
  if (in_slab_ == bytes / sizeof(EntryBlock)) ++slab_, in_slab_ = 0;
  if (slab_ == slabs_.size()) slabs_.push_back(make_slab(slab_ == 0));
  ++used_;
  return static_cast<EntryBlock*>(slabs_[slab_].get()) + in_slab_++;
}

void Bin::grow(BlockPool& pool) {
  EntryBlock* const block = pool.take();
  block->next = nullptr;
  (last == nullptr ? first : last->next) = block;
  last = block;
  in_last = 0;
}

}  // namespace farop::tiled
