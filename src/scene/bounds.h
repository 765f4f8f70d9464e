// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "scene/scene.h"

namespace farop {

struct Bounds {
  V3d low, high;
};

/// Axis-parallel box of all polygon vertices in world space; nothing for a scene without any.
std::optional<Bounds> world_bounds(const Scene& scene);

}  // namespace farop
