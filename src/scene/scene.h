// SPDX-License-Identifier: GPL-3.0-or-later
// The scene tree: what parsers build and the geometry stage reads.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/math.h"
#include "scene/surface.h"
#include "scene/view.h"

namespace farop {

/// A node of the tree. A transformation reaches all sub-objects. Surfaces and sub-trees may be shared
/// (instances).
struct Object {
  std::string name;
  M44d to_parent;  ///< row-vector matrix; identity by default
  std::vector<std::shared_ptr<Surface>> surfaces;
  std::vector<std::shared_ptr<Object>> children;
};

/// A light in world space. Without a colour it is white and its intensity is the program's choice.
struct Light {
  V3d position{0, 0, 0};  ///< of a directional one: unit vector from the scene TO the light
  std::optional<Rgb> color;
  LightKind kind = LightKind::point;
  V3d target{0, 0, 0};         ///< spots: a point in the middle of the cone
  double opening_degrees = 0;  ///< spots: full angle of the cone, 0..360
  bool casts_shadows = false;  ///< spots
  int shadow_size = 256;       ///< side of its shadow map, texels
  bool active = true;          ///< an inactive one gives no light
  friend bool operator==(const Light&, const Light&) = default;
};

/// Counts of one input, as read.
struct InputSummary {
  std::string file;
  std::string format;  ///< "nff", "sipp"
  std::uint64_t bytes = 0, surfaces = 0, polygons = 0, patches = 0, spheres = 0, cones = 0, lights = 0;
};

/// Root object + lights + view + background (in view). All of an NFF file is ONE object under the root, and
/// so is the world of a SIPP scene; the root itself has no surfaces.
struct Scene {
  Object root;
  std::vector<Light> lights;
  ViewParameters view;
  DrawingParameters drawing;
  std::vector<InputSummary> inputs;
  std::uint64_t spheres_skipped = 0, cones_skipped = 0;  ///< left out by `--detail 0`
};

/// Equal trees: names, matrices, surfaces with materials, vertices and polygons, lights and view. Inputs do
/// not count.
bool same_content(const Scene& a, const Scene& b);

}  // namespace farop
