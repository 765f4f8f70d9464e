// SPDX-License-Identifier: GPL-3.0-or-later
// SIPP's three shaders without a pattern: basic, Phong and Strauss.
//
// The functions compute in whatever space point and lights are given in (world space for C programs, eye
// space in FAROP's stages); the classes serve surfaces of a scene. Common to all: N is the normal made a unit
// vector, V the direction to the eye, R = 2 (N.L) N - L, and per light of colour Lc the fraction s and
// direction L of illuminate(); basic and Phong skip lights with s <= 0.0001, Strauss looks at neither cone
// nor shadow (as SIPP 3.1 did). Minima are per channel.
#pragma once

#include <span>

#include "shading/shader.h"

namespace farop {

struct BasicParameters {
  double ambient = 0;   ///< share of `color` that is there without any light
  double specular = 0;  ///< strength of the highlight, which has the light's colour
  double c3 = 1;        ///< width of the highlight: 0 tight, 1 broad
  Rgb color{1, 1, 1};
  Rgb opacity{1, 1, 1};
};

struct PhongParameters {
  double ambient = 0;
  double diffuse = 1;
  double specular = 0;
  int spec_exp = 1;  ///< exponent of (R.V)
  Rgb color{1, 1, 1};
  Rgb opacity{1, 1, 1};
};

struct StraussParameters {
  double ambient = 0;
  double smoothness = 0;  ///< 0..1: from matt to a mirror
  double metalness = 0;   ///< 0..1: from plastic to metal, whose highlights have the surface's colour
  Rgb color{1, 1, 1};
  Rgb opacity{1, 1, 1};
};

/// min(1, C (ambient + D) + specular S) with D = min(1, sum over N.L > 0 of Lc s (N.L)) and S = min(1, sum
/// over R.V > 0 of Lc s c3^2 (R.V) / ((R.V)^2 (c3^2 - 1) + 1)). The highlight does not ask for N.L > 0.
Rgb basic_color(const BasicParameters& parameters, const ShadingPoint& point,
                std::span<const LightSource> lights);

/// min(1, C (ambient + diffuse D) + specular S), D as above, S = min(1, sum over R.V > 0 of Lc s
/// (R.V)^spec_exp).
Rgb phong_color(const PhongParameters& parameters, const ShadingPoint& point,
                std::span<const LightSource> lights);

/// P. Strauss, "A Realistic Lighting Model for Computer Animators", IEEE CG&A 10(6), 1990, as SIPP has it:
/// the Fresnel and shadowing terms take cosines. Darker the smoother and the more metallic. Smoothness 1
/// leaves a highlight in the exact mirror direction only.
Rgb strauss_color(const StraussParameters& parameters, const ShadingPoint& point,
                  std::span<const LightSource> lights);

/// NFF's exponent whose highlight has the same half width as basic's with `c3` > 0: 1 for 1, about 34 for
/// 0.2.
double shine_of_c3(double c3);

/// NFF's nearest to the basic shader; see Shader::approximate().
Material approximate_basic(const BasicParameters& parameters, std::vector<std::string>* lost);

class BasicShader : public Shader {
 public:
  explicit BasicShader(const BasicParameters& parameters) : parameters_(parameters) {}
  const BasicParameters& parameters() const { return parameters_; }

  Shaded shade(const ShadingPoint& point, const ShadingFrame& frame) const override;
  bool opaque() const override;
  bool invisible() const override;
  bool is_pure() const override { return true; }
  Material approximate(std::vector<std::string>* lost = nullptr) const override;
  std::string describe() const override;

 private:
  BasicParameters parameters_;
};

class PhongShader : public Shader {
 public:
  explicit PhongShader(const PhongParameters& parameters) : parameters_(parameters) {}
  const PhongParameters& parameters() const { return parameters_; }

  Shaded shade(const ShadingPoint& point, const ShadingFrame& frame) const override;
  bool opaque() const override;
  bool invisible() const override;
  bool is_pure() const override { return true; }
  Material approximate(std::vector<std::string>* lost = nullptr) const override;
  std::string describe() const override;

 private:
  PhongParameters parameters_;
};

class StraussShader : public Shader {
 public:
  explicit StraussShader(const StraussParameters& parameters) : parameters_(parameters) {}
  const StraussParameters& parameters() const { return parameters_; }

  Shaded shade(const ShadingPoint& point, const ShadingFrame& frame) const override;
  bool opaque() const override;
  bool invisible() const override;
  bool is_pure() const override { return true; }
  Material approximate(std::vector<std::string>* lost = nullptr) const override;
  std::string describe() const override;

 private:
  StraussParameters parameters_;
};

}  // namespace farop
