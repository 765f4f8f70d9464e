// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with all that the geometry stage tells apart, mixed at random.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/math.h"
#include "geometry/pipeline.h"
#include "scene/scene.h"

namespace farop::test {

struct RandomScene {
  Scene scene;
  Camera camera;
  Viewport viewport;
  GeometryOptions options;
  PolygonWants wants;
  bool shadows = false;                      ///< lights of the setup get shadows
  std::shared_ptr<std::vector<V3d>> shaded;  ///< points that shaders which are not pure were called for
};

/// The same for the same number, on one machine.
RandomScene random_scene(std::uint32_t number);

/// prepare_geometry(), with shadows.
GeometrySetup prepare(const RandomScene& scene);

}  // namespace farop::test
