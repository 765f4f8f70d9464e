// SPDX-License-Identifier: GPL-3.0-or-later
// The program's world as it is now -> a scene of ours.
#pragma once

#include "library_internal.h"
#include "scene/scene.h"

namespace farop::sipp_api {

struct SnapshotOptions {
  bool shaders = true;         ///< bind them; without: for depths only
  bool interruptible = false;  ///< see bound_shader()
  bool materials = false;      ///< fill Surface::material too (asks shader functions of the program)
};

/// The tree below sipp_world as the only child of the root, named "world"; all lights, newest first; view
/// from the active camera, background, two_sided. Geometry is shared with the C surfaces, deformed surfaces
/// are copies. Throws Error(ExitStatus::input) for trees with cycles and for a camera that sees nothing.
Scene snapshot(const SnapshotOptions& options);

/// The camera of a snapshot's view.
farop::Camera camera_of(const ViewParameters& view);

}  // namespace farop::sipp_api
