// SPDX-License-Identifier: GPL-3.0-or-later
// Shaders as a script makes them: kind and parameters, bound to surfaces until the scene is taken.
#pragma once

#include <memory>
#include <variant>

#include "shading/procedural_shaders.h"
#include "shading/sipp_shaders.h"

namespace farop::sipp {

class ScriptShader;

template <class Pattern>
struct PatternSpec {
  PatternFinish finish;
  Pattern pattern;
};
struct BumpySpec {
  std::shared_ptr<const ScriptShader> inner;
  BumpParameters parameters;
};
using ShaderSpec = std::variant<BasicParameters, PhongParameters, StraussParameters, PatternSpec<WoodPattern>,
                                PatternSpec<MarblePattern>, PatternSpec<GranitePattern>,
                                PatternSpec<BozoPattern>, PatternSpec<PlanetPattern>, BumpySpec>;

/// Stands for a shader on the surfaces of a scene under construction; shades nothing itself.
class ScriptShader : public Shader {
 public:
  explicit ScriptShader(ShaderSpec spec, int depth = 1) : spec_(std::move(spec)), depth_(depth) {}
  const ShaderSpec& spec() const { return spec_; }
  int depth() const { return depth_; }  ///< of shaders inside shaders

  Shaded shade(const ShadingPoint&, const ShadingFrame&) const override { return {}; }
  bool opaque() const override { return true; }
  Material approximate(std::vector<std::string>*) const override { return {}; }
  std::string describe() const override { return {}; }

 private:
  ShaderSpec spec_;
  int depth_;
};

}  // namespace farop::sipp
