// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of programs as files, instead of their pictures.
#pragma once

#include <cstdio>

#include "geometry/pipeline.h"
#include "library_internal.h"

namespace farop::sipp_api {

/// A render call.
struct RenderRequest {
  int width, height, mode, oversampling, field;
  std::FILE* file;  ///< or:
  void (*func)();
  void* data;
};

/// Writes the scene of `request` where FAROP_CAPTURE or farop_sipp_capture() say so. True when nothing is
/// left to do: the picture itself is not wanted. Throws Error when the file cannot be written; an older file
/// of that name is then untouched.
bool capture(const RenderRequest& request);

/// Lights, shadows and noise as for a picture.
void shade_frame(const Scene& scene, GeometrySetup& setup);

}  // namespace farop::sipp_api
