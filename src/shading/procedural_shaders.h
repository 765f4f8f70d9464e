// SPDX-License-Identifier: GPL-3.0-or-later
// SIPP's shaders that make a pattern from texture coordinates.
//
// As in sipp_shaders.h the functions work in any space; patterns depend on the texture coordinates T alone.
// The noise is that of the frame (ShadingFrame::noise). Sources: K. Perlin, "An Image Synthesizer", SIGGRAPH
// 1985; D. Peachey, "Solid Texturing of Complex Surfaces", SIGGRAPH 1985.
#pragma once

#include <functional>
#include <memory>

#include "shading/noise.h"
#include "shading/sipp_shaders.h"

namespace farop {

/// What the basic shader adds to a pattern's colour.
struct PatternFinish {
  double ambient = 0, specular = 0, c3 = 1;
  Rgb opacity{1, 1, 1};

  BasicParameters with(const Rgb& color) const { return {ambient, specular, c3, color, opacity}; }
};

/// Veins of `strip` in `base`, along x.
struct MarblePattern {
  double scale = 1;
  Rgb base, strip;

  Rgb color(const V3d& texture, const NoiseTable& noise) const;
  Rgb mean() const;
  std::string describe() const;
  static constexpr const char* name = "marble";
};

/// Specks of two colours; not limited to 0..1.
struct GranitePattern {
  double scale = 1;
  Rgb color1, color2;

  Rgb color(const V3d& texture, const NoiseTable& noise) const;
  Rgb mean() const;
  std::string describe() const;
  static constexpr const char* name = "granite";
};

/// Patches of as many colours as are given; white without any.
struct BozoPattern {
  double scale = 1;
  std::vector<Rgb> colors;

  Rgb color(const V3d& texture, const NoiseTable& noise) const;
  Rgb mean() const;
  std::string describe() const;
  static constexpr const char* name = "bozo";
};

/// Planks along x, 45 / scale thick, with year rings.
struct WoodPattern {
  double scale = 1;
  Rgb base, ring;

  Rgb color(const V3d& texture, const NoiseTable& noise) const;
  Rgb mean() const;
  std::string describe() const;
  static constexpr const char* name = "wood";
};

/// Land, sea and clouds; clouds may be whiter than white.
struct PlanetPattern {
  Rgb color(const V3d& texture, const NoiseTable& noise) const;
  Rgb mean() const;
  std::string describe() const;
  static constexpr const char* name = "planet";
};

struct BumpParameters {
  double scale = 1;  ///< of the texture coordinates: a larger one makes more bumps, not higher ones
  bool bumps = true, holes = true;
};

/// `normal` (any length), bent as SIPP's bumpy shader does: made a unit vector, plus the noise's gradient
/// where the noise is negative (bumps), positive (holes), or everywhere (both). Not a unit vector. Normal and
/// gradient are taken for vectors of the same space: the world's.
V3d bumpy_normal(const BumpParameters& parameters, const V3d& normal, const V3d& texture,
                 const NoiseTable& noise);

/// A pattern under the basic shader.
template <class Pattern>
class PatternShader : public Shader {
 public:
  PatternShader(PatternFinish finish, Pattern pattern) : finish_(finish), pattern_(std::move(pattern)) {}
  const PatternFinish& finish() const { return finish_; }
  const Pattern& pattern() const { return pattern_; }

  Shaded shade(const ShadingPoint& point, const ShadingFrame& frame) const override;
  bool opaque() const override;
  bool invisible() const override;
  bool is_procedural() const override { return true; }
  bool is_pure() const override { return true; }
  /// The pattern's mean colour.
  Material approximate(std::vector<std::string>* lost = nullptr) const override;
  std::string describe() const override;

 private:
  PatternFinish finish_;
  Pattern pattern_;
};

using MarbleShader = PatternShader<MarblePattern>;
using GraniteShader = PatternShader<GranitePattern>;
using BozoShader = PatternShader<BozoPattern>;
using WoodShader = PatternShader<WoodPattern>;
using PlanetShader = PatternShader<PlanetPattern>;

/// Any shader with a normal that bumpy_normal() has bent, in world space.
class BumpyShader : public Shader {
 public:
  /// `inner` is not nullptr.
  BumpyShader(std::shared_ptr<const Shader> inner, const BumpParameters& parameters)
      : inner_(std::move(inner)), parameters_(parameters) {}

  Shaded shade(const ShadingPoint& point, const ShadingFrame& frame) const override;
  bool opaque() const override { return inner_->opaque(); }
  bool invisible() const override { return inner_->invisible(); }
  bool is_pure() const override { return inner_->is_pure(); }
  bool is_procedural() const override { return true; }
  Material approximate(std::vector<std::string>* lost = nullptr) const override;
  std::string describe() const override;

 private:
  std::shared_ptr<const Shader> inner_;
  BumpParameters parameters_;
};

/// One of two shaders at each point, as a test of the texture coordinates says.
class MaskShader : public Shader {
 public:
  using Test = std::function<bool(const V3d& texture)>;

  /// `where_set`, `elsewhere` and `test` are not empty. `name` tells masks apart in describe(): equal names
  /// mean equal tests.
  MaskShader(std::shared_ptr<const Shader> where_set, std::shared_ptr<const Shader> elsewhere, Test test,
             std::string name);

  Shaded shade(const ShadingPoint& point, const ShadingFrame& frame) const override;
  bool opaque() const override { return where_set_->opaque() && elsewhere_->opaque(); }
  bool invisible() const override { return where_set_->invisible() && elsewhere_->invisible(); }
  bool is_procedural() const override { return true; }
  /// That of the shader where the mask is set.
  Material approximate(std::vector<std::string>* lost = nullptr) const override;
  std::string describe() const override;

 private:
  std::shared_ptr<const Shader> where_set_, elsewhere_;
  Test test_;
  std::string name_;
};

}  // namespace farop
