// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/surface.h"

namespace farop {

void PolygonRecorder::begin_polygon(bool has_given_normals) {
  open_ = records_.size();
  records_.push_back(has_given_normals ? PolygonList::k_given_normals : 0);
}

void PolygonRecorder::end_polygon() {
  records_[open_] |= static_cast<std::uint32_t>(records_.size() - open_ - 1);
  ++count_;
}

void PolygonRecorder::add_polygon(std::span<const std::uint32_t> corners, bool has_given_normals) {
  records_.push_back(static_cast<std::uint32_t>(corners.size()) |
                     (has_given_normals ? PolygonList::k_given_normals : 0));
  for (const std::uint32_t corner : corners) records_.push_back(corner);
  ++count_;
}

PolygonList PolygonRecorder::take() {
  open_ = 0;
  return PolygonList(records_.move_to_vector(), std::exchange(count_, 0));
}

std::size_t Surface::memory_bytes() const {
  return sizeof(Surface) +
         (positions.capacity() + normals.capacity() + averaged_normals.capacity()) * sizeof(V3d) +
         textures.capacity() * sizeof(V3f) + polygons.memory_bytes() +
         curved.capacity() * sizeof(CurvedPrimitive);
}

bool operator==(const Surface& a, const Surface& b) {
  const bool same_shader = a.shader == b.shader || (a.shader != nullptr && b.shader != nullptr &&
                                                    a.shader->describe() == b.shader->describe());
  return same_shader && a.material == b.material && a.normal_rule == b.normal_rule &&
         a.positions == b.positions && a.normals == b.normals && a.textures == b.textures &&
         a.polygons == b.polygons && a.curved == b.curved &&
         (a.normal_rule != NormalRule::sipp || a.averaged_normals == b.averaged_normals);
}

}  // namespace farop
