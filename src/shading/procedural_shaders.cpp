// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading/procedural_shaders.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "shading/opacity_internal.h"
#include "shading/sipp_text_internal.h"

namespace farop {
namespace {

/// `share` of `to`, the rest of `from`.
Rgb mix(const Rgb& from, const Rgb& to, double share) {
  return from + (to + from * -1) * share;
}

const NoiseTable& noise_of(const ShadingFrame& frame) {
  return frame.noise ? *frame.noise : *standard_noise();
}

/// Octaves of noise, each twice as fine and `decay` times as strong, as many as `size` has binary digits.
double planet_turbulence(V3d p, int size, double decay, const NoiseTable& noise) {
  double sum = noise.noise(p);
  double weight = 1;
  for (int counter = 1; counter < size; counter *= 2) {
    p *= 2.0;
    weight *= decay;
    sum += weight * noise.noise(p);
  }
  return sum;
}

/// Moves a coordinate into the board around 0 and returns the board's number, counted away from 0 both ways.
double enter_board(double& q) {
  constexpr double size = 45;
  if (q > 0) {
    const double board = std::floor((q + size / 2) / size);
    q -= board * size;
    return board;
  }
  const double board = std::floor((size / 2 - q) / size);
  q += board * size;
  return board;
}

constexpr Rgb k_white{1, 1, 1}, k_land{0.28125, 0.1875, 0.09375}, k_sea{0, 0, 1};

}  // namespace

Rgb MarblePattern::color(const V3d& texture, const NoiseTable& noise) const {
  const V3d q = texture * scale;
  const double x = std::abs(std::sin(q.x + 5 * noise.turbulence(q, 7)));
  if (x < 0.1) return strip;
  if (x < 0.9) return mix(strip, base, 7.0 / 6 - 1 / (6.25 * x + 0.375));
  return base;
}

Rgb MarblePattern::mean() const {
  return mix(strip, base, 0.832);  // over whole periods of the sine
}

std::string MarblePattern::describe() const {
  return fmt::format("{} {} {}", scale, color_text(base), color_text(strip));
}

Rgb GranitePattern::color(const V3d& texture, const NoiseTable& noise) const {
  V3d q = texture * scale;
  double n = 0.5;
  double frequency = 1;
  for (int octave = 0; octave < 6; ++octave) {
    q *= 4 * frequency;  // of what the octave before left
    n += 0.5 * noise.noise(q) / frequency;
    frequency *= 2;
  }
  return color1 * n + color2 * (1 - n);
}

Rgb GranitePattern::mean() const {
  return mix(color1, color2, 0.5);
}

std::string GranitePattern::describe() const {
  return fmt::format("{} {} {}", scale, color_text(color1), color_text(color2));
}

Rgb BozoPattern::color(const V3d& texture, const NoiseTable& noise) const {
  if (colors.empty()) return k_white;
  const auto count = static_cast<double>(colors.size());
  const double index = (noise.noise(texture * scale) + 1) * count / 2;
  return colors[static_cast<std::size_t>(std::clamp(index, 0.0, count - 1))];
}

Rgb BozoPattern::mean() const {
  // Noise is near 0 more often than near its ends: count where it falls.
  BozoPattern unscaled = *this;
  unscaled.scale = 1;
  Rgb sum;
  constexpr int side = 12;
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) sum += unscaled.color(V3d(x, y, z) * 0.7, *standard_noise());
    }
  }
  return sum * (1.0 / (side * side * side));
}

std::string BozoPattern::describe() const {
  std::vector<std::string> words;
  words.reserve(colors.size());
  for (const Rgb& c : colors) words.push_back(color_text(c));
  return fmt::format("{} {{{}}}", scale, fmt::join(words, " "));
}

Rgb WoodPattern::color(const V3d& texture, const NoiseTable& noise) const {
  V3d q = texture * scale;
  const double along = q.x;
  q.x *= 0.08;
  const double chaos = 0.5 * noise.turbulence(q, 5);
  const double streak = noise.noise(q);
  const double board_z = enter_board(q.z);
  const double board_y = enter_board(q.y);
  const double skew = (0.05 + 0.03 * noise.noise(V3d(0, board_y, board_z))) * (along - 2);
  q.z -= skew;
  q.y -= skew;
  const double radius = std::hypot(q.y, q.z) + chaos;
  const double v = radius - std::floor(radius);
  if (streak > 0 && streak < 0.01) return ring;
  if (v < 0.1) return base;
  if (v < 0.9) return mix(ring, base, 1 - std::pow(v / 0.8 - 0.1, 6));
  return ring;
}

Rgb WoodPattern::mean() const {
  return mix(ring, base, 0.764);  // over whole rings
}

std::string WoodPattern::describe() const {
  return fmt::format("{} {} {}", scale, color_text(base), color_text(ring));
}

Rgb PlanetPattern::color(const V3d& texture, const NoiseTable& noise) const {
  const Rgb ground = planet_turbulence(texture, 430, 0.7, noise) > 0.15 ? k_land : k_sea;
  const double cloud = planet_turbulence(texture * 12.0, 18, 0.6, noise) + 0.25;
  return cloud > 0 ? mix(ground, k_white, cloud) : ground;
}

Rgb PlanetPattern::mean() const {
  return {0.264, 0.248, 0.845};  // sampled in many places
}

std::string PlanetPattern::describe() const {
  return "";
}

V3d bumpy_normal(const BumpParameters& parameters, const V3d& normal, const V3d& texture,
                 const NoiseTable& noise) {
  const V3d q = texture * parameters.scale;
  const double n = noise.noise(q);
  const bool bent =
      (parameters.bumps && parameters.holes) || (n < 0 && parameters.bumps) || (n > 0 && parameters.holes);
  return bent ? normal.normalized() + noise.gradient(q) : normal;
}

template <class Pattern>
Shaded PatternShader<Pattern>::shade(const ShadingPoint& point, const ShadingFrame& frame) const {
  const Rgb color = pattern_.color(point.texture, noise_of(frame));
  return {clamp01(basic_color(finish_.with(color), point, frame.lights)), finish_.opacity};
}

template <class Pattern>
bool PatternShader<Pattern>::opaque() const {
  return hides_all(finish_.opacity);
}

template <class Pattern>
bool PatternShader<Pattern>::invisible() const {
  return hides_nothing(finish_.opacity);
}

template <class Pattern>
Material PatternShader<Pattern>::approximate(std::vector<std::string>* lost) const {
  if (lost != nullptr) lost->push_back(fmt::format("patterns of {} shaders", Pattern::name));
  return approximate_basic(finish_.with(pattern_.mean()), lost);
}

template <class Pattern>
std::string PatternShader<Pattern>::describe() const {
  const std::string pattern = pattern_.describe();
  return fmt::format("{} {} {} {}{}{} {}", Pattern::name, finish_.ambient, finish_.specular, finish_.c3,
                     pattern.empty() ? "" : " ", pattern, color_text(finish_.opacity));
}

template class PatternShader<MarblePattern>;
template class PatternShader<GranitePattern>;
template class PatternShader<BozoPattern>;
template class PatternShader<WoodPattern>;
template class PatternShader<PlanetPattern>;

Shaded BumpyShader::shade(const ShadingPoint& point, const ShadingFrame& frame) const {
  V3d normal_world;
  frame.eye_to_world.multDirMatrix(point.normal, normal_world);
  const V3d bent_world = bumpy_normal(parameters_, normal_world, point.texture, noise_of(frame));
  ShadingPoint bent = point;
  frame.eye_to_world.transposed().multDirMatrix(bent_world, bent.normal);  // a rotation (and a reflection)
  return inner_->shade(bent, frame);
}

Material BumpyShader::approximate(std::vector<std::string>* lost) const {
  if (lost != nullptr) lost->emplace_back("bumps of bumpy shaders");
  return inner_->approximate(lost);
}

std::string BumpyShader::describe() const {
  return fmt::format("bumpy {{{}}} {}{}{}", inner_->describe(), parameters_.scale,
                     parameters_.bumps ? " BUMPS" : "", parameters_.holes ? " HOLES" : "");
}

MaskShader::MaskShader(std::shared_ptr<const Shader> where_set, std::shared_ptr<const Shader> elsewhere,
                       Test test, std::string name)
    : where_set_(std::move(where_set)),
      elsewhere_(std::move(elsewhere)),
      test_(std::move(test)),
      name_(std::move(name)) {}

Shaded MaskShader::shade(const ShadingPoint& point, const ShadingFrame& frame) const {
  return (test_(point.texture) ? where_set_ : elsewhere_)->shade(point, frame);
}

Material MaskShader::approximate(std::vector<std::string>* lost) const {
  if (lost != nullptr) lost->emplace_back("masks of mask shaders (the shader where the mask is set stays)");
  return where_set_->approximate(lost);
}

std::string MaskShader::describe() const {
  return fmt::format("mask {} {{{}}} {{{}}}", name_, where_set_->describe(), elsewhere_->describe());
}

}  // namespace farop
