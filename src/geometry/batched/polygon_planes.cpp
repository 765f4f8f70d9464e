// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/batched/polygon_planes.h"

namespace farop::batched {
namespace {

inline void fill_lane(Row* row, std::size_t lane, const V3d* positions, const std::uint32_t* corners,
                      std::size_t size) {
  for (std::size_t c = 0; c < size; ++c, row += 3) {
    const V3d& p = positions[corners[c]];
    row[0].values[lane] = p.x, row[1].values[lane] = p.y, row[2].values[lane] = p.z;
  }
}

}  // namespace

void PolygonPlanes::clear() {
  groups_.clear();
  rows_.clear();
  places_.clear();
  open_.fill(0);
}

std::uint32_t PolygonPlanes::open_group(std::size_t corners, std::size_t rows) {
  PlaneGroup group;
  group.first_row = static_cast<std::uint32_t>(rows_.size());
  group.corners = static_cast<std::uint32_t>(corners);
  rows_.resize(rows_.size() + rows);
  groups_.push_back(group);
  return static_cast<std::uint32_t>((groups_.size() - 1) * k_lanes);
}

void PolygonPlanes::add(std::span<const V3d> positions, std::span<const std::uint32_t> corners) {
  const std::size_t size = corners.size();
  if (size > k_short) {
    const std::size_t rows = PlaneGroup::rows_of_long(size);
    const std::uint32_t place = open_group(size, 3 * rows);
    groups_.back().is_long = true;
    double* x = rows_[groups_.back().first_row].values;
    double *y = x + rows * k_lanes, *z = y + rows * k_lanes;
    for (std::size_t c = 0; c < rows * k_lanes; ++c) {
      const V3d& p = positions[corners[c < size ? c : 0]];
      x[c] = p.x, y[c] = p.y, z[c] = p.z;
    }
    places_.push_back(place);
    return;
  }
  std::uint32_t& open = open_[size];
  if (open % k_lanes == 0) open = open_group(size, 3 * size);
  Row* row = rows_.data() + groups_[open / k_lanes].first_row;
  const std::size_t lane = open % k_lanes;
  if (size == 3) {  // loops of known length
    fill_lane(row, lane, positions.data(), corners.data(), 3);
  } else if (size == 4) {
    fill_lane(row, lane, positions.data(), corners.data(), 4);
  } else {
    fill_lane(row, lane, positions.data(), corners.data(), size);
  }
  places_.push_back(open++);
}

void PolygonPlanes::find(const V3d& eye) {
  find_planes(groups_, rows_.data(), eye);
}

}  // namespace farop::batched
