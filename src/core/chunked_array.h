// SPDX-License-Identifier: GPL-3.0-or-later
// An array that grows without copying and gives its memory back piece by piece.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace farop {

/// For data of unknown length that may come to gigabytes: a std::vector holds the old and the new copy while
/// it grows, and again while it is trimmed. Chunks come straight from the system, because the allocator keeps
/// freed blocks of this size for later. The first one is kept by clear() and move_to_vector(), so that many
/// small arrays cost no allocation.
template <class T>
class ChunkedArray {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return chunks_[i / k_chunk].get()[i % k_chunk]; }
  const T& operator[](std::size_t i) const { return chunks_[i / k_chunk].get()[i % k_chunk]; }

  void push_back(const T& value) {
    if (size_ == chunks_.size() * k_chunk) chunks_.push_back(make_chunk());
    ::new (static_cast<void*>(&(*this)[size_])) T(value);
    ++size_;
  }
  /// Only towards a smaller size.
  void truncate(std::size_t size) { size_ = size; }
  void assign(std::size_t count, const T& value) {
    clear();
    while (size_ < count) push_back(value);
  }
  void clear() {
    if (chunks_.size() > 1) chunks_.resize(1);
    size_ = 0;
  }

  /// All elements in a vector of exactly their number; the array is empty afterwards. Beside the elements
  /// themselves at most one chunk of memory is in use at any time.
  std::vector<T> move_to_vector() {
    std::vector<T> out;
    out.reserve(size_);
    for (std::size_t c = 0; c < chunks_.size() && out.size() < size_; ++c) {
      const T* const first = chunks_[c].get();
      out.insert(out.end(), first, first + std::min(k_chunk, size_ - out.size()));
      if (c > 0) chunks_[c].reset();
    }
    clear();
    return out;
  }

 private:
  /// A power of two: an index is split by a shift and a mask.
  static constexpr std::size_t k_chunk = std::bit_floor((std::size_t{1} << 20) / sizeof(T));

  struct Unmap {
    void operator()(T* chunk) const { ::munmap(chunk, k_chunk * sizeof(T)); }
  };
  using Chunk = std::unique_ptr<T, Unmap>;

  static Chunk make_chunk() {
    void* const memory =
        ::mmap(nullptr, k_chunk * sizeof(T), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    return Chunk(static_cast<T*>(memory));
  }

  std::vector<Chunk> chunks_;
  std::size_t size_ = 0;
};

}  // namespace farop
