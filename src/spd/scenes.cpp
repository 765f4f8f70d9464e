// SPDX-License-Identifier: GPL-3.0-or-later
#include "spd/scenes.h"

#include <numbers>

namespace farop {
namespace {

double shine_of_half_angle(double degrees) {
  if (degrees <= 0) return 100000;
  if (degrees >= 90) return 1;
  return std::log(0.5) / std::log(std::cos(radians(degrees)));
}

}  // namespace

Material material(const Rgb& color, double kd, double ks, double half_angle, double transmittance,
                  double refraction) {
  Material m;
  m.color = color;
  m.kd = kd;
  m.ks = ks;
  m.shine = shine_of_half_angle(half_angle);
  m.transmittance = transmittance;
  m.refraction = refraction;
  return m;
}

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

M44d rotation(const V3d& axis, double radians) {
  return M44d().setAxisAngle(axis, radians);
}

}  // namespace farop
