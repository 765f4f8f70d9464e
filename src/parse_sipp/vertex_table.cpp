// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/vertex_table.h"

#include <utility>

namespace farop::sipp {
namespace {

constexpr std::size_t k_first_table = 64;
constexpr std::size_t k_largest_kept_table = 4096;

}  // namespace

void VertexTable::reset(double tolerance) {
  // A table that one huge surface left behind would be slow to clear for every small one after it.
  if (slots_.size() > k_largest_kept_table) {
    std::vector<Slot>().swap(slots_);
  } else {
    std::fill(slots_.begin(), slots_.end(), Slot{});
  }
  size_ = 0;
  // Wider than the tolerance by more than the rounding of v - reach: what lies within the tolerance of v lies
  // in a cell between the two that search() looks at, because cell() is monotonous.
  reach_ = tolerance * 1.001;
  cells_per_unit_ = std::min(1 / (64 * tolerance), 1e300);
}

void VertexTable::insert(const VertexKey& key, std::uint32_t vertex) {
  if (3 * slots_.size() < 4 * (size_ + 1)) grow();  // three quarters full at most
  std::uint64_t hash = kind(key);
  for (std::size_t i = 0; i < key.size(); ++i) hash += mixed(cell(key.components[i]), i);
  insert_slot({finished(hash), vertex + 1});
  ++size_;
}

void VertexTable::insert_slot(Slot slot) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = slot.tag & mask;
  while (slots_[at].vertex != 0) at = (at + 1) & mask;
  slots_[at] = slot;
}

void VertexTable::grow() {
  const std::vector<Slot> old =
      std::exchange(slots_, std::vector<Slot>(slots_.empty() ? k_first_table : 2 * slots_.size()));
  for (const Slot& slot : old) {
    if (slot.vertex != 0) insert_slot(slot);
  }
}

}  // namespace farop::sipp
