// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/surface_builder.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace farop {
namespace {

constexpr std::size_t k_first_table = 64;
constexpr std::size_t k_largest_kept_table = 4096;
constexpr std::size_t k_corners_at_once = 256;

struct Corner {
  V3d position, normal;
};

// Sums of products with odd constants, which do not wait for each other; the high half of the sum is mixed
// into the low one that the table uses. Before, the high half of every coordinate goes into its low one: of
// round numbers (powers of two divided) all the other bits are 0, and a product never moves bits down.
// (Constants: fractional digits of square roots of primes.)
std::uint64_t hash_of(const V3d& p) {
  const auto bits = [](double v) {
    const auto b = std::bit_cast<std::uint64_t>(v);
    return b ^ (b >> 32);
  };
  const std::uint64_t h =
      bits(p.x) * 0x6A09E667F3BCC909u + bits(p.y) * 0xBB67AE8584CAA73Bu + bits(p.z) * 0x3C6EF372FE94F82Bu;
  return (h ^ (h >> 32)) * 0xA54FF53A5F1D36F1u;
}

std::uint64_t hash_of(const V3d& p, const V3d& n, bool given) {
  const std::uint64_t h = hash_of(p) + (given ? hash_of(n) * 0x9E3779B97F4A7C15u + 1 : 0);
  return h ^ (h >> 29);
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
  polygons_.begin_polygon(has_given_normals);
}

void SurfaceBuilder::add_corner(const V3d& position) {
  polygons_.add_corner(vertex(position, V3d(0, 0, 0), false));
}

void SurfaceBuilder::add_corner(const V3d& position, const V3d& normal) {
  polygons_.add_corner(vertex(position, normal, true));
}

void SurfaceBuilder::add_polygons(std::span<const double> numbers,
                                  std::span<const std::uint32_t> corner_counts, bool has_given_normals) {
  if (has_given_normals) {
    find_vertices(numbers.size() / 6, true, [&](std::size_t i) {
      const double* const n = numbers.data() + 6 * i;
      return Corner{V3d(n[0], n[1], n[2]), V3d(n[3], n[4], n[5])};
    });
  } else {
    find_vertices(numbers.size() / 3, false, [&](std::size_t i) {
      const double* const n = numbers.data() + 3 * i;
      return Corner{V3d(n[0], n[1], n[2]), V3d(0, 0, 0)};
    });
  }
  const std::uint32_t* vertex = vertices_.data();
  for (const std::uint32_t corners : corner_counts) {
    polygons_.add_polygon({vertex, corners}, has_given_normals);
    vertex += corners;
  }
}

void SurfaceBuilder::append(const Surface& surface) {
  const std::uint64_t polygons_before = polygons_.size();
  const auto corner = [&](std::size_t v) {
    return Corner{surface.positions[v], surface.normals.empty() ? V3d(0, 0, 0) : surface.normals[v]};
  };
  const bool given = !surface.normals.empty();
  const bool of_one_kind =
      !given || std::all_of(surface.polygons.begin(), surface.polygons.end(),
                            [](const PolygonView& polygon) { return polygon.has_given_normals; });
  if (of_one_kind) {
    // The surface's vertices stand in order of first use, so new ones get their numbers in that order here.
    find_vertices(surface.positions.size(), given, corner);
    for (const PolygonView polygon : surface.polygons) {
      polygons_.begin_polygon(given);
      for (const std::uint32_t v : polygon.corners) polygons_.add_corner(vertices_[v]);
      polygons_.end_polygon();
    }
  } else {
    for (const PolygonView polygon : surface.polygons) {
      begin_polygon(polygon.has_given_normals);
      for (const std::uint32_t v : polygon.corners) {
        const auto [position, normal] = corner(v);
        polygon.has_given_normals ? add_corner(position, normal) : add_corner(position);
      }
      end_polygon();
    }
  }
  for (CurvedPrimitive curved : surface.curved) {
    curved.after_polygons += polygons_before;
    curved_.push_back(curved);
  }
}

void SurfaceBuilder::add(const Sphere& sphere) {
  curved_.push_back({CurvedPrimitive::Kind::sphere, sphere, {}, polygons_.size()});
}

void SurfaceBuilder::add(const Cone& cone) {
  curved_.push_back({CurvedPrimitive::Kind::cone, {}, cone, polygons_.size()});
}

std::uint32_t SurfaceBuilder::vertex(const V3d& position, const V3d& normal, bool given) {
  see_corners(given);
  make_room(1);
  return find_vertex(hash_of(position, normal, given), position, normal, given);
}

// In large surfaces a vertex is far away in memory, twice: its place in the table, and itself. So all are
// asked for before the first is needed.
template <class GetCorner>
void SurfaceBuilder::find_vertices(std::size_t count, bool given, const GetCorner& corner) {
  if (count == 0) return;
  see_corners(given);
  make_room(count);
  const std::size_t mask = table_.size() - 1;
  hashes_.resize(std::min(count, k_corners_at_once));
  vertices_.resize(count);
  for (std::size_t first = 0; first < count; first += k_corners_at_once) {
    const std::size_t some = std::min(count - first, k_corners_at_once);
    for (std::size_t i = 0; i < some; ++i) {
      const auto [position, normal] = corner(first + i);
      hashes_[i] = hash_of(position, normal, given);
      __builtin_prefetch(&table_[hashes_[i] & mask]);
    }
    for (std::size_t i = 0; i < some; ++i) {
      if (const std::uint32_t v = table_[hashes_[i] & mask]; v != 0) __builtin_prefetch(&positions_[v - 1]);
    }
    for (std::size_t i = 0; i < some; ++i) {
      const auto [position, normal] = corner(first + i);
      vertices_[first + i] = find_vertex(hashes_[i], position, normal, given);
    }
  }
}

// A vertex is known to have a given normal when the surface has any and either all have (no plain corner
// seen) or its flag says so; the flags exist only in surfaces that mix both kinds.
void SurfaceBuilder::see_corners(bool given) {
  if (given && !any_given_) {
    any_given_ = true;
    normals_.assign(positions_.size(), V3d(0, 0, 0));
  }
  if (!given) any_plain_ = true;
  if (mixed() && given_.size() < positions_.size()) given_.resize(positions_.size(), !given);
}

std::uint32_t SurfaceBuilder::find_vertex(std::uint64_t hash, const V3d& position, const V3d& normal,
                                          bool given) {
  const std::size_t mask = table_.size() - 1;
  for (std::size_t slot = hash & mask;; slot = (slot + 1) & mask) {
    if (table_[slot] == 0) {
      positions_.push_back(position);
      if (any_given_) normals_.push_back(normal);
      if (mixed()) given_.push_back(given);
      table_[slot] = static_cast<std::uint32_t>(positions_.size());
      return table_[slot] - 1;
    }
    const std::uint32_t v = table_[slot] - 1;
    if (!same_bits(positions_[v], position)) continue;
    if (mixed() && given_[v] != given) continue;
    if (given && !same_bits(normals_[v], normal)) continue;
    return v;
  }
}

void SurfaceBuilder::make_room(std::size_t vertices) {
  // Three quarters full at most.
  const std::size_t needed = positions_.size() + vertices;
  if (3 * table_.size() >= 4 * needed) return;
  const std::size_t size = std::max(k_first_table, std::bit_ceil(needed + needed / 3 + 1));
  release(table_);  // before the larger one is there
  table_.assign(size, 0);
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    const bool given = mixed() ? static_cast<bool>(given_[v]) : any_given_;
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
