// SPDX-License-Identifier: GPL-3.0-or-later
#include "solids/check_solid.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "geometry/triangulate.h"
#include "scene/plane.h"
#include "scene/traverse.h"

namespace farop {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct PositionHash {
  std::size_t operator()(const V3d& p) const {
    const std::hash<double> hash;
    return hash(p.x) * 0x9E3779B97F4A7C15u ^ hash(p.y) * 0xC2B2AE3D27D4EB4Fu ^ hash(p.z);
  }
};

/// All polygons of an object over one list of vertices.
struct Polygons {
  std::vector<V3d> positions;
  std::vector<std::uint32_t> corners;
  std::vector<std::size_t> first = {0};  ///< polygon -> its first corner; one more than there are polygons

  std::uint64_t size() const { return first.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t polygon) const {
    return {corners.data() + first[polygon], first[polygon + 1] - first[polygon]};
  }
};

Polygons collect(const Object& object) {
  Polygons all;
  std::unordered_map<V3d, std::uint32_t, PositionHash> numbers;
  for_each_surface(object, M44d(), [&](const SurfacePlacement& placement) {
    const Surface& surface = placement.surface;
    const M44d& to_parent = placement.local_to_world;
    std::vector<std::uint32_t> number(surface.positions.size());
    for (std::size_t i = 0; i < number.size(); ++i) {
      const V3d p = surface.positions[i] * to_parent + V3d(0, 0, 0);  // -0 becomes 0
      const auto [found, added] = numbers.try_emplace(p, static_cast<std::uint32_t>(all.positions.size()));
      if (added) all.positions.push_back(p);
      number[i] = found->second;
    }
    const bool mirrored = to_parent.determinant() < 0;  // turns polygons over, but not what is their front
    for (const PolygonView polygon : surface.polygons) {
      for (const std::uint32_t corner : polygon.corners) all.corners.push_back(number[corner]);
      const auto start = static_cast<std::ptrdiff_t>(all.first.back());
      if (mirrored) std::reverse(all.corners.begin() + start, all.corners.end());
      all.first.push_back(all.corners.size());
    }
  });
  return all;
}

/// Edges with a direction: (from, to) -> the corner at `from`.
class HalfEdges {
 public:
  explicit HalfEdges(const Polygons& all) : all_(all) {
    by_ends_.reserve(all.corners.size());
    next_.resize(all.corners.size()), polygon_.resize(all.corners.size());
    for (std::size_t p = 0; p < all.size(); ++p) {
      for (std::size_t c = all.first[p]; c < all.first[p + 1]; ++c) {
        next_[c] = c + 1 < all.first[p + 1] ? c + 1 : all.first[p];
        polygon_[c] = p;
      }
    }
    for (std::size_t c = 0; c < next_.size(); ++c) ++by_ends_[key(from(c), to(c))].count;
    for (std::size_t c = next_.size(); c-- > 0;) by_ends_[key(from(c), to(c))].corner = c;
  }

  std::size_t size() const { return next_.size(); }
  std::uint64_t edges() const {
    std::uint64_t twice = 0;
    for (const auto& [ends, use] : by_ends_) {
      const bool both_ways = by_ends_.contains(ends << 32 | ends >> 32);
      twice += both_ways ? 1 : 2;
    }
    return twice / 2;
  }
  std::uint32_t from(std::size_t corner) const { return all_.corners[corner]; }
  std::uint32_t to(std::size_t corner) const { return all_.corners[next_[corner]]; }
  std::size_t next(std::size_t corner) const { return next_[corner]; }
  std::size_t polygon(std::size_t corner) const { return polygon_[corner]; }
  /// How many polygons run from a to b.
  std::uint32_t count(std::uint32_t a, std::uint32_t b) const {
    const auto found = by_ends_.find(key(a, b));
    return found == by_ends_.end() ? 0 : found->second.count;
  }
  /// The first corner from which a polygon runs from a to b. There must be one.
  std::size_t corner(std::uint32_t a, std::uint32_t b) const { return by_ends_.at(key(a, b)).corner; }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }
  struct Use {
    std::uint32_t count = 0;
    std::size_t corner = 0;
  };

  const Polygons& all_;
  std::unordered_map<std::uint64_t, Use> by_ends_;
  std::vector<std::size_t> next_, polygon_;
};

using Flaw = std::optional<SolidFlaw>;

Flaw find_improper_polygon(const Polygons& all) {
  for (std::size_t p = 0; p < all.size(); ++p) {
    const auto ring = all[p];
    bool proper = plane_normal(all.positions, ring).has_value();
    for (std::size_t i = 0; i < ring.size(); ++i) proper = proper && ring[i] != ring[(i + 1) % ring.size()];
    if (!proper) return SolidFlaw{SolidProperty::proper_polygons, p, {}, all.positions[ring[0]]};
  }
  return {};
}

Flaw find_open_edge(const Polygons& all, const HalfEdges& edges) {
  for (std::size_t c = 0; c < edges.size(); ++c) {
    if (edges.count(edges.from(c), edges.to(c)) + edges.count(edges.to(c), edges.from(c)) == 1) {
      return SolidFlaw{SolidProperty::closed, edges.polygon(c), {}, all.positions[edges.from(c)]};
    }
  }
  return {};
}

Flaw find_crowded_edge(const Polygons& all, const HalfEdges& edges) {
  for (std::size_t c = 0; c < edges.size(); ++c) {
    if (edges.count(edges.from(c), edges.to(c)) + edges.count(edges.to(c), edges.from(c)) > 2) {
      return SolidFlaw{SolidProperty::manifold, edges.polygon(c), {}, all.positions[edges.from(c)]};
    }
  }
  return {};
}

Flaw find_edge_run_twice(const Polygons& all, const HalfEdges& edges) {
  for (std::size_t c = 0; c < edges.size(); ++c) {
    if (edges.count(edges.from(c), edges.to(c)) < 2) continue;
    const std::size_t first = edges.corner(edges.from(c), edges.to(c));
    if (first == c) continue;
    return SolidFlaw{SolidProperty::oriented, edges.polygon(first), edges.polygon(c),
                     all.positions[edges.from(c)]};
  }
  return {};
}

// Walks round every vertex, from polygon to neighbour. Needs edges of exactly two polygons in opposite
// directions.
Flaw find_crowded_vertex(const Polygons& all, const HalfEdges& edges) {
  std::vector<bool> seen(edges.size()), has_ring(all.positions.size());
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (seen[start]) continue;
    const std::uint32_t vertex = edges.from(start);
    if (has_ring[vertex]) {
      return SolidFlaw{SolidProperty::manifold, edges.polygon(start), {}, all.positions[vertex]};
    }
    has_ring[vertex] = true;
    for (std::size_t c = start; !seen[c]; c = edges.next(edges.corner(edges.to(c), vertex))) seen[c] = true;
  }
  return {};
}

/// The surface as triangles, and the polygon of every triangle.
struct TriangleMesh {
  Mesh mesh;
  std::vector<std::size_t> polygon;
};

Flaw triangulate_all(const Polygons& all, TriangleMesh& result) {
  for (const V3d& p : all.positions) result.mesh.add_vertex({p.x, p.y, p.z});
  TriangulateScratch scratch;
  std::vector<V3d> ring;
  std::vector<CornerTriangle> triangles;
  for (std::size_t p = 0; p < all.size(); ++p) {
    const auto corners = all[p];
    ring.clear();
    for (const std::uint32_t corner : corners) ring.push_back(all.positions[corner]);
    triangulate(ring, *plane_normal(all.positions, corners), triangles, scratch);
    for (const auto& [a, b, c] : triangles) {
      const Mesh::Face_index face = result.mesh.add_face(
          Mesh::Vertex_index(corners[a]), Mesh::Vertex_index(corners[b]), Mesh::Vertex_index(corners[c]));
      // A diagonal that other triangles have used up: polygons that lie on each other.
      if (face == Mesh::null_face()) {
        return SolidFlaw{SolidProperty::not_intersecting, p, {}, all.positions[corners[a]]};
      }
      result.polygon.push_back(p);
    }
  }
  return {};
}

Flaw find_intersection(const Polygons& all, const TriangleMesh& triangles) {
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  pmp::self_intersections(triangles.mesh, std::back_inserter(pairs));
  Flaw first;
  for (const auto& [a, b] : pairs) {
    const auto [low, high] = std::minmax(triangles.polygon[a], triangles.polygon[b]);
    if (first && std::pair<std::uint64_t, std::uint64_t>(first->polygon, *first->other_polygon) <=
                     std::pair<std::uint64_t, std::uint64_t>(low, high)) {
      continue;
    }
    first = SolidFlaw{SolidProperty::not_intersecting, low, high, all.positions[all[low][0]]};
  }
  return first;
}

// Shells inside an even number of others bound material from outside, the rest are hollows.
Flaw find_inward_shell(const Polygons& all, TriangleMesh& triangles, std::uint64_t& shells) {
  Mesh& mesh = triangles.mesh;
  const auto shell = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:shell", 0).first;
  const auto volume = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:volume", 0).first;
  shells = pmp::connected_components(mesh, shell);
  std::vector<std::size_t> levels;
  std::vector<bool> outward;
  pmp::volume_connected_components(
      mesh, volume,
      CGAL::parameters::nesting_levels(std::ref(levels)).is_cc_outward_oriented(std::ref(outward)));
  for (const Mesh::Face_index face : mesh.faces()) {
    const std::size_t k = shell[face];
    if (outward.at(k) == (levels.at(k) % 2 == 0)) continue;
    const std::size_t p = triangles.polygon[face];
    return SolidFlaw{SolidProperty::outward, p, {}, all.positions[all[p][0]]};
  }
  return {};
}

}  // namespace

const char* name_of(SolidProperty property) {
  switch (property) {
    case SolidProperty::proper_polygons:
      return "made of proper polygons";
    case SolidProperty::closed:
      return "closed";
    case SolidProperty::manifold:
      return "manifold";
    case SolidProperty::oriented:
      return "consistently oriented";
    case SolidProperty::not_intersecting:
      return "free of self-intersections";
    case SolidProperty::outward:
      break;
  }
  return "oriented outwards";
}

std::string describe(const SolidFlaw& flaw) {
  const char* const what = [&] {
    switch (flaw.property) {
      case SolidProperty::proper_polygons:
        return "has no area or a repeated corner";
      case SolidProperty::closed:
        return "has no neighbour over an edge";
      case SolidProperty::manifold:
        return "has more than one neighbour over an edge or in a vertex";
      case SolidProperty::oriented:
        return "run along their edge in the same direction";
      case SolidProperty::not_intersecting:
        return flaw.other_polygon ? "intersect" : "lies on another one";
      case SolidProperty::outward:
        break;
    }
    return "shows its front to the inside";
  }();
  const std::string which = flaw.other_polygon
                                ? fmt::format("polygons {} and {}", flaw.polygon, *flaw.other_polygon)
                                : fmt::format("polygon {}", flaw.polygon);
  return fmt::format("not {}: {} {}, at ({:g}, {:g}, {:g})", name_of(flaw.property), which, what,
                     flaw.position.x, flaw.position.y, flaw.position.z);
}

SolidReport check_solid(const Object& object) {
  const Polygons all = collect(object);
  SolidReport report;
  report.polygons = all.size();
  const HalfEdges edges(all);
  report.edges = edges.edges();
  std::vector<bool> used(all.positions.size());
  for (const std::uint32_t corner : all.corners) used[corner] = true;
  report.vertices = static_cast<std::uint64_t>(std::count(used.begin(), used.end(), true));

  TriangleMesh triangles;
  const std::function<Flaw()> questions[] = {
      [&] { return find_improper_polygon(all); },
      [&] { return find_open_edge(all, edges); },
      [&] { return find_crowded_edge(all, edges); },
      [&] { return find_edge_run_twice(all, edges); },
      [&] { return find_crowded_vertex(all, edges); },
      [&] { return triangulate_all(all, triangles); },
      [&] { return find_intersection(all, triangles); },
      [&] { return find_inward_shell(all, triangles, report.shells); },
  };
  for (const auto& question : questions) {
    report.flaw = question();
    if (report.flaw || all.size() == 0) break;
  }
  return report;
}

}  // namespace farop
