// SPDX-License-Identifier: GPL-3.0-or-later
// From shaders as C programs give them, function and description, to shaders of our stages.
#pragma once

#include <memory>

#include "library_internal.h"
#include "shading/shader.h"

namespace farop::sipp_api {

/// Calls a shader function of any program: arguments as in shaders.h.
void call_shader(::Shader* function, Vector* position, Vector* normal, Vector* texture, Vector* view_vec,
                 Lightsource* lights, void* description, Color* color, Color* opacity);
bool ask_masker(const Mask_desc& description, Vector* texture);

/// The shader of a surface. One of SIPP's own becomes ours, its description read now; any other function is
/// called point by point, in world space. `interruptible`: work is counted, and Terminated thrown when the
/// program has asked for it. nullptr without a function, and for descriptions that nest too deeply.
std::shared_ptr<const farop::Shader> bound_shader(::Shader* function, void* description, bool interruptible);

}  // namespace farop::sipp_api
