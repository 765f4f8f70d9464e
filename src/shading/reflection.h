// SPDX-License-Identifier: GPL-3.0-or-later
// Phong's reflection model (Bui Tuong Phong, "Illumination for Computer Generated Pictures", CACM 18(6),
// 1975).
#pragma once

#include <span>

#include "core/math.h"
#include "shading/light.h"
#include "shading/material.h"

namespace farop {

/// Intensity at a point:
///
///   I = Ka C Ia + sum over lights of s L (Kd C (N.L) + Ks (R.V)^n),  Ia = 1,  R = 2 (N.L) N - L,
///
/// s the fraction of the light that arrives (illuminate()), 1 for the point lights of NFF;
/// clamped to [0,1] per channel once, at the end. One-sided: a light with N.L <= 0 adds nothing; R.V < 0
/// counts as 0.
///
/// point, eye, lights  in one space, any units
/// normal              unit length, same space
/// errors              none; a light or an eye at the point itself adds no directed term
Rgb reflect(const Material& material, std::span<const LightSource> lights, const V3d& point,
            const V3d& normal, const V3d& eye);

}  // namespace farop
