// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes that the checker draws: computed ones, and those by script that come with the program.
#pragma once

#include <vector>

#include "conformance/corpus.h"

namespace farop::app {

/// What a level has, as polygons and as triangles: at the default level all computed scenes, small;
/// thoroughly three sizes of them and the scenes by script (none where their folder is not installed).
/// Nothing is made before it is drawn. Their draw() throws Error(surroundings) where no process can be
/// started for a script.
std::vector<conformance::SceneSource> check_scenes(conformance::Level level);

}  // namespace farop::app
