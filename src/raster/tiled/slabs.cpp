// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/tiled/slabs.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <new>

namespace farop::tiled {

Slab make_slab(bool first) {
  const std::size_t bytes = first ? k_first_slab_bytes : k_slab_bytes;
  void* const memory = std::aligned_alloc(bytes, bytes);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
  if (!first) madvise(memory, bytes, MADV_HUGEPAGE);  // a wish, no more
#endif
  return Slab(memory);
}

}  // namespace farop::tiled
