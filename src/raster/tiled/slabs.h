// SPDX-License-Identifier: GPL-3.0-or-later
// Memory that a frame fills and the next one uses again.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <type_traits>
#include <vector>

namespace farop::tiled {

/// Slabs use huge pages where the system gives them, but for the first one: what is filled once is filled
/// faster, and what is jumped about in costs no walks through the page table. Small frames need a slab only,
/// and clearing all of a huge page takes them too long.
constexpr std::size_t k_first_slab_bytes = std::size_t{1} << 19, k_slab_bytes = std::size_t{1} << 21;

struct FreeSlab {
  void operator()(void* slab) const { std::free(slab); }
};
using Slab = std::unique_ptr<void, FreeSlab>;

/// Aligned to its size, contents unset. Throws std::bad_alloc.
Slab make_slab(bool first);

/// An array that grows without moving what it holds.
template <class T>
class SlabArray {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::size_t bytes() const { return size_ * sizeof(T); }
  const T& operator[](std::size_t i) const { return *at(i); }
  const T& back() const { return *at(size_ - 1); }
  void push_back(const T& value) {
    if (size_ == room_) grow();
    ::new (static_cast<void*>(at(size_))) T(value);
    ++size_;
  }
  void clear() { size_ = 0; }

 private:
  static constexpr std::size_t k_first = std::bit_floor(k_first_slab_bytes / sizeof(T));
  static constexpr std::size_t k_other = std::bit_floor(k_slab_bytes / sizeof(T));

  T* at(std::size_t i) const {
    if (i < k_first) return static_cast<T*>(slabs_[0].get()) + i;
    i -= k_first;
    return static_cast<T*>(slabs_[1 + i / k_other].get()) + i % k_other;
  }
  void grow() {
    slabs_.push_back(make_slab(slabs_.empty()));
    room_ += slabs_.size() == 1 ? k_first : k_other;
  }

  std::vector<Slab> slabs_;
  std::size_t size_ = 0, room_ = 0;
};

}  // namespace farop::tiled
