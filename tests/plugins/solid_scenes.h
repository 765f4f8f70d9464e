// SPDX-License-Identifier: GPL-3.0-or-later
// The three solids that ship, as polygons on the screen with the ids of their vertices.
#pragma once

#include <string>
#include <vector>

#include "plugins/plugin_driver.h"
#include "scene/scene.h"
#include "scene/view.h"

namespace farop::test {

/// "hollow-cube", "solid-torus" or "solid-cylinder", read from spd_scenes/. Throws std::runtime_error.
Scene load_solid(const std::string& name);

/// The view of the scene, and one of a sphere of views round its middle (any number >= 0).
Camera own_view(const Scene& scene);
Camera other_view(const Scene& scene, std::uint64_t number);

struct SolidRequest {
  int width = 400, height = 600, subpixel_bits = 0;
  bool two_sided = true, flat = true, triangles = false;
};

/// What polygon() gets, in order, with ids: the index of a vertex in its surface, FAROP_NO_VERTEX_ID where
/// clipping made it. Without any clipping, or the ids are left out; triangles have none.
std::vector<PluginPolygon> screen_polygons(const Scene& scene, const Camera& camera,
                                           const SolidRequest& request);

}  // namespace farop::test
