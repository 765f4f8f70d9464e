// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/surface_builder.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace farop {
namespace {

constexpr std::size_t k_first_table = 64;
constexpr std::size_t k_largest_kept_table = 4096;

std::uint64_t mix(std::uint64_t hash, double value) {
  // A multiply-xorshift step per coordinate (the constant is 2^64 divided by the golden ratio).
  hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15u;
  return hash ^ (hash >> 29);
}

std::uint64_t hash_of(const V3d& p, const V3d& n, bool given) {
  std::uint64_t h = mix(mix(mix(given ? 1 : 0, p.x), p.y), p.z);
  if (given) h = mix(mix(mix(h, n.x), n.y), n.z);
  return h ^ (h >> 32);
}

/// Gives the memory back, which an assignment does not.
void release(std::vector<std::uint32_t>& table) {
  std::vector<std::uint32_t>().swap(table);
}

// Equality of bits, not of values: 0 and -0 are different corners, as read.
bool same_bits(const V3d& a, const V3d& b) {
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y) && bits(a.z) == bits(b.z);
}

}  // namespace

void SurfaceBuilder::begin_polygon(bool has_given_normals) {
  if (has_given_normals && !any_given_) {
    any_given_ = true;
    normals_.assign(positions_.size(), V3d(0, 0, 0));
  }
  polygons_.begin_polygon(has_given_normals);
}

void SurfaceBuilder::add_corner(const V3d& position) {
  polygons_.add_corner(vertex(position, V3d(0, 0, 0), false));
}

void SurfaceBuilder::add_corner(const V3d& position, const V3d& normal) {
  polygons_.add_corner(vertex(position, normal, true));
}

void SurfaceBuilder::add(const Sphere& sphere) {
  curved_.push_back({CurvedPrimitive::Kind::sphere, sphere, {}, polygons_.size()});
}

void SurfaceBuilder::add(const Cone& cone) {
  curved_.push_back({CurvedPrimitive::Kind::cone, {}, cone, polygons_.size()});
}

// A vertex is known to have a given normal when the surface has any and either all have (no plain corner
// seen) or its flag says so; the flags exist only in surfaces that mix both kinds.
std::uint32_t SurfaceBuilder::vertex(const V3d& position, const V3d& normal, bool given) {
  if (!given) any_plain_ = true;
  const bool mixed = any_plain_ && any_given_;
  if (mixed && given_.size() < positions_.size()) given_.resize(positions_.size(), !given);
  if (3 * table_.size() < 4 * (positions_.size() + 1)) grow();  // three quarters full at most
  const std::size_t mask = table_.size() - 1;
  for (std::size_t slot = hash_of(position, normal, given) & mask;; slot = (slot + 1) & mask) {
    if (table_[slot] == 0) {
      positions_.push_back(position);
      if (any_given_) normals_.push_back(normal);
      if (mixed) given_.push_back(given);
      table_[slot] = static_cast<std::uint32_t>(positions_.size());
      return table_[slot] - 1;
    }
    const std::uint32_t v = table_[slot] - 1;
    if (!same_bits(positions_[v], position)) continue;
    if (mixed && given_[v] != given) continue;
    if (given && !same_bits(normals_[v], normal)) continue;
    return v;
  }
}

void SurfaceBuilder::grow() {
  const std::size_t size = std::max(k_first_table, 2 * table_.size());
  release(table_);  // before the larger one is there
  table_.assign(size, 0);
  const bool mixed = any_given_ && any_plain_;
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    const bool given = mixed ? static_cast<bool>(given_[v]) : any_given_;
    const V3d normal = given ? normals_[v] : V3d(0, 0, 0);
    std::size_t slot = hash_of(positions_[v], normal, given) & (size - 1);
    while (table_[slot] != 0) slot = (slot + 1) & (size - 1);
    table_[slot] = static_cast<std::uint32_t>(v + 1);
  }
}

Surface SurfaceBuilder::take(const Material& next_material) {
  // A table that one huge surface left behind would be slow to clear for every small one after it, and would
  // stand in memory beside the finished surface.
  if (table_.size() > k_largest_kept_table) {
    release(table_);
  } else {
    std::fill(table_.begin(), table_.end(), 0);
  }
  Surface done;
  done.material = std::exchange(material_, next_material);
  done.positions = positions_.move_to_vector();
  done.normals = normals_.move_to_vector();
  done.polygons = polygons_.take();
  curved_.shrink_to_fit();
  done.curved = std::exchange(curved_, {});
  given_.clear();
  any_given_ = any_plain_ = false;
  return done;
}

}  // namespace farop
