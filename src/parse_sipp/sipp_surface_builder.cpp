// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/sipp_surface_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/plane.h"

namespace farop::sipp {
namespace {

/// Tolerance as a fraction of the first distance, and where there is no distance yet.
constexpr double k_tolerance = 1e-10;
constexpr std::uint32_t k_none = 0xFFFFFFFFu;

VertexKey key_of(const Vertex& v) {
  const V3d n = v.normal.value_or(V3d(0, 0, 0));
  return {{v.position.x, v.position.y, v.position.z, v.texture.x, v.texture.y, v.texture.z, n.x, n.y, n.z},
          v.normal.has_value()};
}

bool finite(const VertexKey& key) {
  return std::all_of(key.components.begin(), key.components.end(), [](double c) { return std::isfinite(c); });
}

bool within(const V3d& a, const V3d& b, double tolerance) {
  return std::abs(a.x - b.x) <= tolerance && std::abs(a.y - b.y) <= tolerance &&
         std::abs(a.z - b.z) <= tolerance;
}

}  // namespace

SurfaceBuilder::SurfaceBuilder() {
  reset_vertices();
}

void SurfaceBuilder::push_vertex(const Vertex& vertex) {
  stack_indices_.push_back(stored(vertex));
  stack_.push_back(vertex);
}

bool SurfaceBuilder::push_polygon() {
  const bool polygon = stack_.size() >= 3;
  if (polygon) {
    corners_.insert(corners_.end(), stack_indices_.begin(), stack_indices_.end());
    counts_.push_back(static_cast<std::uint32_t>(stack_.size()));
  }
  stack_.clear();
  stack_indices_.clear();
  return polygon;
}

void SurfaceBuilder::clear() {
  corners_.clear();
  counts_.clear();
  stack_.clear();
  stack_indices_.clear();
  reset_vertices();
}

std::uint32_t SurfaceBuilder::stored(const Vertex& vertex) {
  const VertexKey key = key_of(vertex);
  const bool comparable = finite(key);
  if (comparable) {
    if (!positions_.empty()) update_tolerance(vertex.position);
    const std::uint32_t found = find(vertex, key);
    if (found != k_none) return found;
  }
  const auto number = static_cast<std::uint32_t>(positions_.size());
  positions_.push_back(vertex.position);
  textures_.push_back(vertex.texture);
  if (vertex.normal && normals_.empty()) {
    normals_.assign(number, V3d(0, 0, 0));
    has_normal_.assign(number, false);
  }
  if (vertex.normal || !normals_.empty()) {
    normals_.push_back(vertex.normal.value_or(V3d(0, 0, 0)));
    has_normal_.push_back(vertex.normal.has_value());
  }
  if (comparable) table_.insert(key, number);
  return number;
}

std::uint32_t SurfaceBuilder::find(const Vertex& vertex, const VertexKey& key) const {
  std::uint32_t first = k_none;
  table_.search(key, [&](std::uint32_t v) {
    if (v >= first || !within(vertex.position, positions_[v], tolerance_) ||
        !within(vertex.texture, textures_[v], tolerance_)) {
      return;
    }
    const bool own_normal = !has_normal_.empty() && has_normal_[v];
    if (own_normal != key.has_normal) return;
    if (own_normal && !within(*vertex.normal, normals_[v], tolerance_)) return;
    first = v;
  });
  return first;
}

void SurfaceBuilder::update_tolerance(const V3d& position) {
  if (tolerance_frozen_) return;
  const V3d d = position - positions_[0];
  double tolerance = k_tolerance * std::hypot(d.x, d.y, d.z);
  if (std::isnan(tolerance)) return;  // the first vertex is not finite: nothing is ever frozen
  tolerance_frozen_ = tolerance > 0;
  tolerance_ = tolerance_frozen_ ? std::min(tolerance, std::numeric_limits<double>::max()) : k_tolerance;
  if (!tolerance_frozen_) return;
  table_.reset(tolerance_);
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    Vertex vertex{positions_[v], textures_[v], {}};
    if (!has_normal_.empty() && has_normal_[v]) vertex.normal = normals_[v];
    const VertexKey key = key_of(vertex);
    if (finite(key)) table_.insert(key, v);
  }
}

void SurfaceBuilder::reset_vertices() {
  positions_.clear();
  textures_.clear();
  normals_.clear();
  has_normal_.clear();
  table_.reset(k_tolerance);
  tolerance_ = k_tolerance;
  tolerance_frozen_ = false;
}

std::shared_ptr<Surface> SurfaceBuilder::create(std::shared_ptr<const Shader> shader) {
  if (empty()) return nullptr;
  auto surface = std::make_shared<Surface>();
  surface->normal_rule = NormalRule::sipp;
  if (shader) surface->material = shader->approximate();
  surface->shader = std::move(shader);

  PolygonRecorder polygons;
  std::size_t end = corners_.size();
  for (std::size_t i = counts_.size(); i-- > 0;) {
    const std::size_t begin = end - counts_[i];
    polygons.begin_polygon(false);
    for (std::size_t c = begin; c < end; ++c) polygons.add_corner(corners_[c]);
    polygons.end_polygon();
    end = begin;
  }
  surface->polygons = polygons.take();
  surface->textures.reserve(textures_.size());
  for (std::size_t v = 0; v < textures_.size(); ++v) surface->textures.emplace_back(textures_[v]);
  surface->positions = positions_.move_to_vector();
  average_normals(*surface);
  for (std::size_t v = 0; v < has_normal_.size(); ++v) {
    if (has_normal_[v]) surface->averaged_normals[v] = normals_[v].normalized();
  }

  std::vector<std::uint32_t>().swap(corners_);
  std::vector<std::uint32_t>().swap(counts_);
  reset_vertices();
  // What is still on the stack starts the next surface.
  stack_indices_.clear();
  for (const Vertex& vertex : stack_) stack_indices_.push_back(stored(vertex));
  return surface;
}

}  // namespace farop::sipp
