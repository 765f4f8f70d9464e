// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "scene/scene.h"

namespace farop {

/// Adds `next` to `scene`, inputs taken in command-line order: objects, lights and surfaces add up; view
/// parameters and background override one by one, the last input that gives one wins. Reports one warning
/// that names every view parameter that was overridden with another value, located at the input `next` came
/// from.
void merge_into(Scene& scene, Scene next, DiagnosticSink& sink);

/// The camera of `view` with defaults for what is still missing; a warning for each default that nobody asked
/// for (up, angle) and for an `up` along the view direction. Throws Error(ExitStatus::input): "no view
/// entity" without from and at, "degenerate view" with from = at.
Camera complete_camera(const ViewParameters& view, DiagnosticSink& sink);

/// Width and height of the picture: the scene's, else 512 x 512 with a warning.
ViewParameters::Size complete_resolution(const ViewParameters& view, DiagnosticSink& sink);

}  // namespace farop
