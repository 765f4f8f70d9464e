// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/tiled/bins.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <new>

namespace farop::tiled {
namespace {

/// Huge pages, but for the first slab: chains jump from block to block, and each small page would cost a walk
/// through the page table. Small frames need a slab only, and clearing all of a huge page takes them too
/// long.
constexpr std::size_t k_first_slab_bytes = std::size_t{1} << 19, k_slab_bytes = std::size_t{1} << 21;

std::size_t slab_bytes(std::size_t slab) {
  return slab == 0 ? k_first_slab_bytes : k_slab_bytes;
}

}  // namespace

EntryBlock* BlockPool::take() {
  if (in_slab_ == slab_bytes(slab_) / sizeof(EntryBlock)) ++slab_, in_slab_ = 0;
  if (slab_ == slabs_.size()) {
    const std::size_t bytes = slab_bytes(slab_);
    void* const memory = std::aligned_alloc(bytes, bytes);
    if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
    if (bytes == k_slab_bytes) madvise(memory, bytes, MADV_HUGEPAGE);  // a wish, no more
#endif
    slabs_.emplace_back(static_cast<EntryBlock*>(memory));
  }
  ++used_;
  return &slabs_[slab_][in_slab_++];
}

void Bin::grow(BlockPool& pool) {
  EntryBlock* const block = pool.take();
  block->next = nullptr;
  (last == nullptr ? first : last->next) = block;
  last = block;
  in_last = 0;
}

}  // namespace farop::tiled
