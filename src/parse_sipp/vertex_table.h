// SPDX-License-Identifier: GPL-3.0-or-later
// Finds stored vertices that are equal to a new one within a tolerance.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace farop::sipp {

/// What vertices are compared by: position, texture and normal, component by component. Vertices with a
/// normal of their own are a kind apart.
struct VertexKey {
  std::array<double, 9> components{};
  bool has_normal = false;  ///< otherwise the last three components do not count

  std::size_t size() const { return has_normal ? 9 : 6; }
};

/// A hash table over the cells of a grid in the space of keys. Cells are 64 tolerances wide; a search looks
/// into every cell that the tolerance reaches, so that nothing is lost at their borders. Memory: 11 to 22
/// bytes a vertex.
class VertexTable {
 public:
  /// Forgets all vertices. tolerance > 0.
  void reset(double tolerance);
  std::size_t size() const { return size_; }

  /// Adds vertex number `vertex`, whose key is finite.
  void insert(const VertexKey& key, std::uint32_t vertex);

  /// Calls `candidate` with the number of every vertex within the tolerance of `key`, and perhaps with
  /// others.
  template <class Candidate>
  void search(const VertexKey& key, const Candidate& candidate) const {
    if (slots_.empty()) return;
    std::uint64_t hash = kind(key);
    std::array<std::uint64_t, 9> steps{};  ///< into the cell on the other side of a border
    std::size_t borders = 0;
    for (std::size_t i = 0; i < key.size(); ++i) {
      const double v = key.components[i];
      const double low = cell(v - reach_), high = cell(v + reach_);
      const std::uint64_t m = mixed(low, i);
      hash += m;
      if (high != low) steps[borders++] = mixed(high, i) - m;
    }
    for (std::uint32_t choice = 0; choice < (1u << borders); ++choice) {
      std::uint64_t h = hash;
      for (std::size_t b = 0; b < borders; ++b) {
        if (((choice >> b) & 1) != 0) h += steps[b];
      }
      const std::uint32_t tag = finished(h);
      const std::size_t mask = slots_.size() - 1;
      for (std::size_t at = tag & mask; slots_[at].vertex != 0; at = (at + 1) & mask) {
        if (slots_[at].tag == tag) candidate(slots_[at].vertex - 1);
      }
    }
  }

 private:
  struct Slot {
    std::uint32_t tag = 0;     ///< hash of the cell
    std::uint32_t vertex = 0;  ///< number + 1; 0 = free
  };

  /// The offset keeps zero, the commonest coordinate, away from borders.
  double cell(double v) const { return std::floor(v * cells_per_unit_ + 0.37); }
  static std::uint64_t kind(const VertexKey& key) { return key.has_normal ? 0x8F1BBCDCBFA53E0Bu : 0; }
  static std::uint64_t mixed(double cell, std::size_t component) {
    std::uint64_t h = std::bit_cast<std::uint64_t>(cell) + component * 0xD6E8FEB86659FD93u;
    h = (h ^ (h >> 32)) * 0x9E3779B97F4A7C15u;
    return (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9u;
  }
  static std::uint32_t finished(std::uint64_t sum) { return static_cast<std::uint32_t>(sum >> 32); }

  void insert_slot(Slot slot);
  void grow();

  std::vector<Slot> slots_;
  std::size_t size_ = 0;
  double reach_ = 0;
  double cells_per_unit_ = 0;
};

}  // namespace farop::sipp
