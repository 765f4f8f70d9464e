// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/nff_lights.h"

#include <algorithm>

#include "scene/bounds.h"

namespace farop {
namespace {

/// In scene radii: directions to it differ by a millionth over the scene.
constexpr double k_far_away = 1e6;

struct Ball {
  V3d center{0, 0, 0};
  double radius = 1;
};

Ball ball_around(const Scene& scene) {
  const std::optional<Bounds> box = world_bounds(scene);
  if (!box) return {};
  const double radius = (box->high - box->low).length() / 2;
  return {(box->low + box->high) / 2.0, radius > 0 ? radius : 1};
}

Light point_light(const V3d& position, const std::optional<Rgb>& color) {
  Light light;
  light.position = position, light.color = color;
  return light;
}

}  // namespace

std::vector<Light> nff_lights(const Scene& scene, NffLosses& losses) {
  std::vector<Light> points;
  std::optional<Ball> ball;
  for (const Light& light : scene.lights) {
    if (!light.active) {
      losses.add("lights that are switched off");
      continue;
    }
    V3d position = light.position;
    if (light.kind == LightKind::directional) {
      if (!ball) ball = ball_around(scene);
      position = ball->center + light.position * (k_far_away * ball->radius);
      losses.add("directional lights (points far away instead)");
    } else if (light.kind != LightKind::point) {
      losses.add("cones of spot lights (points instead)");
      if (light.casts_shadows) losses.add("shadows");
    }
    points.push_back(point_light(position, light.color));
  }
  const bool sipp = std::any_of(scene.inputs.begin(), scene.inputs.end(),
                                [](const InputSummary& input) { return input.format == "sipp"; });
  if (points.empty() && (sipp || !scene.lights.empty())) {
    points.push_back(point_light(ball_around(scene).center, Rgb{0, 0, 0}));
  }
  return points;
}

}  // namespace farop
