// SPDX-License-Identifier: GPL-3.0-or-later
// sombrero: the height field of a damped cosine.
#include <cmath>
#include <cstdint>

#include "spd/scenes.h"

namespace farop {
namespace {

class Sombrero {
 public:
  explicit Sombrero(int size) : samples_(std::int64_t{32} << (size - 1)) {}

  std::int64_t samples() const { return samples_; }

  /// Heights are sampled with n steps over [-4,4], yet placed with n - 1: the published scene does so.
  CornerLine point(std::int64_t i, std::int64_t j) const {
    return CornerLine(
        {at(j, samples_ - 1), -3 + height(at(j, samples_), at(i, samples_)), at(i, samples_ - 1)});
  }

 private:
  static double at(std::int64_t k, std::int64_t steps) {
    return -4 + 8 * static_cast<double>(k) / static_cast<double>(steps);
  }

  /// In single precision, as published.
  static float height(double x, double y) {
    const double q = std::sqrt(x * x + y * y);
    return static_cast<float>(3 * std::cos(2 * 3.14159265358 * q) * std::exp(-q) / 3);
  }

  std::int64_t samples_;
};

}  // namespace

void print_sombrero(NffPrinter& printer, const SceneForm& form) {
  printer.background(k_sky);
  printer.view({.from = {0, 5, -8}, .at = V3d(0), .up = {0, 0, 1}, .angle = 40, .hither = 0.01});
  printer.light({10, 10, -10});
  printer.fill(material({1, 0.1, 0.1}, 0.8, 0, 40, 0, 1));

  const Sombrero field(form.size);
  for (std::int64_t i = 0; i + 1 < field.samples(); ++i) {
    CornerLine near = field.point(i, 0), far = field.point(i + 1, 0);
    for (std::int64_t j = 0; j + 1 < field.samples(); ++j) {
      const CornerLine next_near = field.point(i, j + 1), next_far = field.point(i + 1, j + 1);
      printer.triangle(near, next_far, next_near);
      printer.triangle(near, far, next_far);
      near = next_near;
      far = next_far;
    }
  }
}

}  // namespace farop
