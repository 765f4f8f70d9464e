// SPDX-License-Identifier: GPL-3.0-or-later
// C descriptions -> parameters of the shaders that draw them.
#pragma once

#include <algorithm>

#include "library_internal.h"
#include "shading/procedural_shaders.h"
#include "shading/sipp_shaders.h"

namespace farop::sipp_api {

inline BasicParameters parameters_of(const Surf_desc& d) {
  return {d.ambient, d.specular, d.c3, to_rgb(d.color), to_rgb(d.opacity)};
}
inline PhongParameters parameters_of(const Phong_desc& d) {
  return {d.ambient, d.diffuse, d.specular, d.spec_exp, to_rgb(d.color), to_rgb(d.opacity)};
}
inline StraussParameters parameters_of(const Strauss_desc& d) {
  return {d.ambient, d.smoothness, d.metalness, to_rgb(d.color), to_rgb(d.opacity)};
}

/// What all patterns share. Surf_desc: the planet's.
template <class Description>
PatternFinish finish_of(const Description& d) {
  return {d.ambient, d.specular, d.c3, to_rgb(d.opacity)};
}

inline MarblePattern pattern_of(const Marble_desc& d) {
  return {d.scale, to_rgb(d.base), to_rgb(d.strip)};
}
inline GranitePattern pattern_of(const Granite_desc& d) {
  return {d.scale, to_rgb(d.col1), to_rgb(d.col2)};
}
inline BozoPattern pattern_of(const Bozo_desc& d) {
  BozoPattern pattern{d.scale, {}};
  for (int i = 0; i < d.no_of_cols; ++i) pattern.colors.push_back(to_rgb(d.colors[i]));
  return pattern;
}
inline WoodPattern pattern_of(const Wood_desc& d) {
  return {d.scale, to_rgb(d.base), to_rgb(d.ring)};
}
inline PlanetPattern pattern_of(const Surf_desc&) {
  return {};
}

inline BumpParameters bumps_of(const Bumpy_desc& d) {
  return {d.scale, d.bumpflag != 0, d.holeflag != 0};
}

}  // namespace farop::sipp_api
