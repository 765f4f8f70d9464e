// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading/sipp_shaders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "shading/opacity_internal.h"
#include "shading/sipp_text_internal.h"

namespace farop {
namespace {

/// Lights that give less are taken for none.
constexpr double k_least_fraction = 0.0001;

Rgb at_most_1(const Rgb& c) {
  return {std::min(1.0, c.r), std::min(1.0, c.g), std::min(1.0, c.b)};
}

/// The sums over all lights that basic and Phong share, each limited to 1.
struct LightSums {
  Rgb diffuse, specular;
};

/// `highlight` maps R.V > 0 to the strength of the mirrored light.
template <class Highlight>
LightSums sum_lights(const ShadingPoint& point, std::span<const LightSource> lights,
                     const Highlight& highlight) {
  LightSums sums;
  const V3d normal = point.normal.normalized();  // Imath leaves a zero vector zero
  for (const LightSource& light : lights) {
    const auto [to_light, fraction] = illuminate(light, point.position);
    if (!(fraction > k_least_fraction)) continue;
    const Rgb arriving = light.color * fraction;
    const double n_dot_l = normal.dot(to_light);
    if (n_dot_l > 0) sums.diffuse += arriving * n_dot_l;
    const double r_dot_v = (2 * n_dot_l * normal - to_light).dot(point.to_eye);
    if (r_dot_v > 0) sums.specular += arriving * highlight(r_dot_v);
  }
  return {at_most_1(sums.diffuse), at_most_1(sums.specular)};
}

constexpr double square(double x) {
  return x * x;
}

// Strauss' fits of the Fresnel reflection and of the geometric attenuation, each 0..1 over 0..1.
constexpr double k_fresnel = 1.2, k_attenuation = 1.031;

double fresnel(double x) {
  constexpr double end = 1 / square(k_fresnel);
  return (1 / square(1 - x - k_fresnel) - end) / (1 / square(1 - k_fresnel) - end);
}

double attenuation(double x) {
  constexpr double start = 1 / square(1 - k_attenuation);
  return (start - 1 / square(1 - x - k_attenuation)) / (start - 1 / square(k_attenuation));
}

double strauss_exponent(double smoothness) {
  return smoothness < 1 ? 3 / (1 - smoothness) : std::numeric_limits<double>::infinity();
}

}  // namespace

Rgb basic_color(const BasicParameters& p, const ShadingPoint& point, std::span<const LightSource> lights) {
  const double k = square(p.c3);
  const LightSums sums = sum_lights(point, lights, [&](double r_dot_v) {
    const double below = square(r_dot_v) * (k - 1) + 1;
    return below > 0 ? k * r_dot_v / below : 0.0;  // c3 = 0 has no highlight, in the middle neither
  });
  return at_most_1(p.color * (Rgb{1, 1, 1} * p.ambient + sums.diffuse) + sums.specular * p.specular);
}

Rgb phong_color(const PhongParameters& p, const ShadingPoint& point, std::span<const LightSource> lights) {
  const LightSums sums =
      sum_lights(point, lights, [&](double r_dot_v) { return std::pow(r_dot_v, p.spec_exp); });
  return at_most_1(p.color * (Rgb{1, 1, 1} * p.ambient + sums.diffuse * p.diffuse) +
                   sums.specular * p.specular);
}

Rgb strauss_color(const StraussParameters& p, const ShadingPoint& point,
                  std::span<const LightSource> lights) {
  const V3d normal = point.normal.normalized();
  const double not_mirrored = 1 - p.smoothness * square(p.smoothness);
  const double mirrored = 1 - not_mirrored;
  const double eye_attenuation = attenuation(normal.dot(point.to_eye));
  const double exponent = strauss_exponent(p.smoothness);
  Rgb sum;
  for (const LightSource& light : lights) {
    const V3d to_light = illuminate(light, point.position).to_light;
    const double n_dot_l = normal.dot(to_light);
    if (!(n_dot_l >= 0)) continue;
    Rgb part = p.color * (n_dot_l * not_mirrored * (1 - p.metalness * p.smoothness));
    const double r_dot_v = (2 * n_dot_l * normal - to_light).dot(point.to_eye);
    if (r_dot_v >= 0) {
      const double f = fresnel(n_dot_l);
      const double reflected =
          std::min(1.0, mirrored + (mirrored + 0.1) * f * attenuation(n_dot_l) * eye_attenuation);
      const Rgb tint = Rgb{1, 1, 1} + (p.color + Rgb{-1, -1, -1}) * (p.metalness * (1 - f));
      part += tint * (reflected * std::pow(r_dot_v, exponent));
    }
    sum += light.color * part;
  }
  return at_most_1(sum + p.color * (p.ambient * not_mirrored));
}

double shine_of_c3(double c3) {
  // Half of the maximum at R.V = c, for basic k c / (c^2 (k - 1) + 1), for NFF c^n.
  const double k = square(c3);
  if (std::abs(1 - k) < 1e-9) return 1;
  const double c = (std::sqrt(k * k - k + 1) - k) / (1 - k);
  return std::log(0.5) / std::log(c);
}

Material approximate_basic(const BasicParameters& p, std::vector<std::string>* lost) {
  Material m;
  m.color = p.color;
  m.kd = 1;
  if (p.specular != 0 && p.c3 != 0) {
    const double shine = shine_of_c3(p.c3);
    if (std::isfinite(shine)) m.ks = p.specular, m.shine = shine;
    if (lost != nullptr && p.c3 != 1) lost->emplace_back("the shape of basic shaders' highlights");
  }
  approximate_common(p.ambient, p.opacity, m, lost);
  return m;
}

Shaded BasicShader::shade(const ShadingPoint& point, const ShadingFrame& frame) const {
  return {clamp01(basic_color(parameters_, point, frame.lights)), parameters_.opacity};
}

bool BasicShader::opaque() const {
  return hides_all(parameters_.opacity);
}

bool BasicShader::invisible() const {
  return hides_nothing(parameters_.opacity);
}

Material BasicShader::approximate(std::vector<std::string>* lost) const {
  return approximate_basic(parameters_, lost);
}

std::string BasicShader::describe() const {
  const BasicParameters& p = parameters_;
  return fmt::format("basic {} {} {} {} {}", p.ambient, p.specular, p.c3, color_text(p.color),
                     color_text(p.opacity));
}

Shaded PhongShader::shade(const ShadingPoint& point, const ShadingFrame& frame) const {
  return {clamp01(phong_color(parameters_, point, frame.lights)), parameters_.opacity};
}

bool PhongShader::opaque() const {
  return hides_all(parameters_.opacity);
}

bool PhongShader::invisible() const {
  return hides_nothing(parameters_.opacity);
}

Material PhongShader::approximate(std::vector<std::string>* lost) const {
  Material m;
  m.color = parameters_.color;
  m.kd = parameters_.diffuse;
  m.ks = parameters_.specular;
  m.shine = std::max(0, parameters_.spec_exp);
  approximate_common(parameters_.ambient, parameters_.opacity, m, lost);
  return m;
}

std::string PhongShader::describe() const {
  const PhongParameters& p = parameters_;
  return fmt::format("phong {} {} {} {} {} {}", p.ambient, p.diffuse, p.specular, p.spec_exp,
                     color_text(p.color), color_text(p.opacity));
}

Shaded StraussShader::shade(const ShadingPoint& point, const ShadingFrame& frame) const {
  return {clamp01(strauss_color(parameters_, point, frame.lights)), parameters_.opacity};
}

bool StraussShader::opaque() const {
  return hides_all(parameters_.opacity);
}

bool StraussShader::invisible() const {
  return hides_nothing(parameters_.opacity);
}

Material StraussShader::approximate(std::vector<std::string>* lost) const {
  const StraussParameters& p = parameters_;
  const double mirrored = std::clamp(p.smoothness * square(p.smoothness), 0.0, 1.0);
  Material m;
  m.color = p.color;
  m.kd = (1 - mirrored) * std::max(0.0, 1 - p.metalness * p.smoothness);
  // The highlight as it is under light from the front: no Fresnel reflection. Metal tints it, NFF cannot.
  const double grey = (p.color.r + p.color.g + p.color.b) / 3;
  const double exponent = strauss_exponent(p.smoothness);
  if (std::isfinite(exponent)) {
    m.ks = std::max(0.0, mirrored * (1 + p.metalness * (grey - 1)));
    m.shine = exponent;
  }
  approximate_common(p.ambient * (1 - mirrored), p.opacity, m, lost);
  if (lost != nullptr) lost->emplace_back("smoothness and metalness of Strauss shaders");
  return m;
}

std::string StraussShader::describe() const {
  const StraussParameters& p = parameters_;
  return fmt::format("strauss {} {} {} {} {}", p.ambient, p.smoothness, p.metalness, color_text(p.color),
                     color_text(p.opacity));
}

}  // namespace farop
