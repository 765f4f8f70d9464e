// SPDX-License-Identifier: GPL-3.0-or-later
// mount: a fractal mountain by midpoint displacement, and four glass spheres above it.
#include <cmath>
#include <cstdint>
#include <numbers>

#include "spd/scenes.h"

namespace farop {
namespace {

class Mountain {
 public:
  Mountain(NffPrinter& printer, int size)
      : printer_(printer), size_(size), cells_(std::int64_t{1} << size), roughness_(roughness()) {}

  void print() { grow(cells_, 0, 0, {0, 0, 0, 0}); }

 private:
  /// Heights of a square, counter-clockwise: lower left, lower right, upper right, upper left.
  struct Heights {
    double z00, z10, z11, z01;
  };

  /// Height change per length for a fractal dimension of the surface that suits mountains.
  static double roughness() {
    const double q = 2 / std::exp(std::numbers::ln2 / 1.2);
    return std::sqrt(q * q - 1);
  }

  /// Square of `width` cells with its lower left corner at cell (x, y).
  void grow(std::int64_t width, std::int64_t x, std::int64_t y, const Heights& h) {
    if (width == 1) {
      print_cell(x, y, h);
      return;
    }
    const std::int64_t half = width / 2;
    const double rise = 2 * static_cast<double>(half) / static_cast<double>(cells_) * roughness_;
    const double lower = (h.z00 + h.z10) / 2 + rise * noise(x + half, y);
    const double right = (h.z10 + h.z11) / 2 + rise * noise(x + width, y + half);
    const double upper = (h.z11 + h.z01) / 2 + rise * noise(x + half, y + width);
    const double left = (h.z01 + h.z00) / 2 + rise * noise(x, y + half);
    const double middle = (h.z00 + h.z10 + h.z11 + h.z01) / 4 + 1.4142136 * rise * noise(x + half, y + half);
    grow(half, x, y, {h.z00, lower, middle, left});
    grow(half, x + half, y, {lower, h.z10, right, middle});
    grow(half, x + half, y + half, {middle, right, h.z11, upper});
    grow(half, x, y + half, {left, middle, upper, h.z01});
  }

  void print_cell(std::int64_t x, std::int64_t y, const Heights& h) {
    const auto at = [this](std::int64_t k) {
      return -1 + 2 * static_cast<double>(k) / static_cast<double>(cells_);
    };
    const CornerLine lower_left({at(x), at(y), h.z00}), lower_right({at(x + 1), at(y), h.z10});
    const CornerLine upper_right({at(x + 1), at(y + 1), h.z11}), upper_left({at(x), at(y + 1), h.z01});
    printer_.triangle(lower_left, lower_right, upper_right);
    printer_.triangle(upper_right, upper_left, lower_left);
  }

  /// Normal deviate that depends on the grid point only, so that neighbouring squares agree: the polar method
  /// of Marsaglia over a linear congruential generator (Knuth), seeded with the point. The seed is a poor
  /// hash; it makes the published shape.
  double noise(std::int64_t x, std::int64_t y) const {
    constexpr std::uint64_t k_modulus = 134456;
    const auto next = [](std::uint64_t i) { return (28411 + 8121 * i) % k_modulus; };
    const auto to_unit = [](std::uint64_t i) {
      return 2 * static_cast<double>(i) / static_cast<double>(k_modulus) - 1;
    };
    std::uint64_t state =
        21 + (shifted(x, 23 - size_) + shifted(y, 15 - size_) + shifted(x, 7 - size_)) % 65536;
    while (true) {
      const std::uint64_t first = next(state);
      state = next(first);
      const double v1 = to_unit(first), v2 = to_unit(state);
      const double r = v1 * v1 + v2 * v2;
      if (r < 1) return v1 * std::sqrt(-2 * std::log(r) / r);
    }
  }

  static std::uint64_t shifted(std::int64_t value, int bits) {
    return bits < 0 ? 0 : static_cast<std::uint64_t>(value) << bits;
  }

  NffPrinter& printer_;
  const int size_;
  const std::int64_t cells_;  ///< along one side; the grid covers [-1,1]^2
  const double roughness_;
};

}  // namespace

void print_mount(NffPrinter& printer, const SceneForm& form) {
  printer.background(k_sky);
  printer.view({.from = {-1.6, 1.6, 1.7}, .at = V3d(0), .up = {0, 0, 1}, .angle = 45, .hither = 0.01});
  printer.light({-100, -100, 100});

  printer.fill(material({1, 1, 1}, 0.1, 0.1, 6.7, 0.9, 1.5));
  const double radius = 0.17;
  const V3d middle(-0.8, 0.8, 1);
  const V3d upward(0, 0, radius * std::sqrt(1.5));
  printer.sphere({middle + upward, radius});
  const V3d sideward = upward * rotation({1, 1, 0}, std::acos(-1.0 / 3));
  for (int i = 0; i < 3; ++i)
    printer.sphere({middle + sideward * rotation({0, 0, 1}, 2 * std::numbers::pi / 3 * i), radius});

  printer.fill(material({0.5, 0.45, 0.35}, 1, 0, 0, 0, 0));
  Mountain(printer, form.size).print();
}

}  // namespace farop
