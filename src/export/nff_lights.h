// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "export/nff_losses.h"
#include "scene/scene.h"

namespace farop {

/// The lights of `scene` as NFF can have them: points. Point lights stay as they are; a directional one
/// becomes a point 10^6 scene radii from the middle of the scene; a spot becomes a point in its place,
/// without cone or shadow; those that are switched off are left out. Where none is left of a scene that has
/// no light from NFF's point of view but is not to get one from its readers (all are switched off, or an
/// input is SIPP), one black light. What is lost is added to `losses`.
std::vector<Light> nff_lights(const Scene& scene, NffLosses& losses);

}  // namespace farop
