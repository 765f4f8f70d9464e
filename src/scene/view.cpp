// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/view.h"

#include <algorithm>
#include <cmath>

namespace farop {
namespace {

/// sin of the angle between `up` and the view direction below which `up` says nothing.
constexpr double k_parallel = 1e-9;

V3d unit_depth(const Camera& camera) {
  return (camera.at - camera.from).normalized();
}

bool parallel(const V3d& depth, const V3d& up) {
  return !(depth.cross(up.normalized()).length() > k_parallel);
}

}  // namespace

double Camera::near_distance() const {
  return std::max(hither, 1e-6 * (at - from).length());
}

bool up_is_parallel(const Camera& camera) {
  return parallel(unit_depth(camera), camera.up);
}

EyeAxes eye_axes(const Camera& camera) {
  const V3d depth = unit_depth(camera);
  V3d up = camera.up;
  if (parallel(depth, up)) {
    const double x = std::abs(depth.x), y = std::abs(depth.y), z = std::abs(depth.z);
    up = z <= x && z <= y ? V3d(0, 0, 1) : y <= x ? V3d(0, 1, 0) : V3d(1, 0, 0);
  }
  const V3d right = depth.cross(up).normalized();
  return {right, right.cross(depth), depth};
}

M44d world_to_eye(const Camera& camera) {
  const auto [r, u, d] = eye_axes(camera);
  const V3d& e = camera.from;
  return {r.x,       u.x,       d.x,       0,  //
          r.y,       u.y,       d.y,       0,  //
          r.z,       u.z,       d.z,       0,  //
          -e.dot(r), -e.dot(u), -e.dot(d), 1};
}

}  // namespace farop
