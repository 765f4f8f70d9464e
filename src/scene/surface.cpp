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

PolygonList PolygonRecorder::take() {
  open_ = 0;
  return PolygonList(records_.move_to_vector(), std::exchange(count_, 0));
}

std::size_t Surface::memory_bytes() const {
  return sizeof(Surface) +
         (positions.capacity() + normals.capacity() + averaged_normals.capacity()) * sizeof(V3d) +
         polygons.memory_bytes() + curved.capacity() * sizeof(CurvedPrimitive);
}

}  // namespace farop
