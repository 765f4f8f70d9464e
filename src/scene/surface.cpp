// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/surface.h"

namespace farop {

void PolygonList::begin_polygon(bool has_given_normals) {
  open_ = records_.size();
  records_.push_back(has_given_normals ? k_given_normals : 0);
}

void PolygonList::end_polygon() {
  records_[open_] |= open_corners();
  ++count_;
}

std::size_t Surface::memory_bytes() const {
  return sizeof(Surface) +
         (positions.capacity() + normals.capacity() + averaged_normals.capacity()) * sizeof(V3d) +
         polygons.memory_bytes() + curved.capacity() * sizeof(CurvedPrimitive);
}

}  // namespace farop
