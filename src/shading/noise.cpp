// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading/noise.h"

#include <cmath>

namespace farop {
namespace {

constexpr double k_lattice_limit = 2147483648.0;  // 2^31

/// Mirrors what lies beyond +-2^31 back into that range.
double fold(double t) {
  if (t >= -k_lattice_limit && t < k_lattice_limit) return t;
  if (!std::isfinite(t)) return 0;
  const double in_period = std::fmod(std::abs(t), 4 * k_lattice_limit);  // mirrored twice: back again
  const double mirrored = in_period > 3 * k_lattice_limit ? in_period - 4 * k_lattice_limit
                          : in_period > k_lattice_limit   ? 2 * k_lattice_limit - in_period
                                                          : in_period;
  return t < 0 ? -mirrored : mirrored;
}

/// Lattice points i, i + 1, i + 2 around a coordinate: their share of the hash, and the spline's weights.
struct Axis {
  Axis(double t, double buckets) {
    t = fold(t);
    const double i = std::floor(t);
    const double f = t - i;
    for (int n = 0; n < 3; ++n) {
      constexpr double phi = 0.6180339;
      const double turned = (i + n) * phi;
      hashes[n] = static_cast<int>(buckets * (turned - std::floor(turned)));
    }
    weights = {0.5 - f + f * f / 2, 0.5 + f - f * f, f * f / 2};
    derivatives = {f - 1, 1 - 2 * f, f};
  }

  std::array<int, 3> hashes{};
  std::array<double, 3> weights{}, derivatives{};
};

struct Cell {
  explicit Cell(const V3d& p) : x(p.x, 173), y(p.y, 263), z(p.z, 337) {}
  std::array<std::array<int, 3>, 3> hashes() const { return {x.hashes, y.hashes, z.hashes}; }
  Axis x, y, z;
};

}  // namespace

double Rand48::next() {
  state_ = (0x5DEECE66Du * state_ + 11) & ((std::uint64_t{1} << 48) - 1);
  return std::ldexp(static_cast<double>(state_), -48);
}

NoiseTable::NoiseTable(const std::function<double()>& uniform) {
  for (double& value : values_) value = 2 * uniform() - 1;
}

double NoiseTable::weighted_sum(const std::array<std::array<int, 3>, 3>& hashes,
                                const std::array<double, 3>& wx, const std::array<double, 3>& wy,
                                const std::array<double, 3>& wz) const {
  double sum = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      const int partial = hashes[0][a] + hashes[1][b];
      double row = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        row += wz[c] * values_[static_cast<std::size_t>(partial + hashes[2][c]) % values_.size()];
      }
      sum += wx[a] * wy[b] * row;
    }
  }
  return sum;
}

double NoiseTable::noise(const V3d& p) const {
  const Cell cell(p);
  return weighted_sum(cell.hashes(), cell.x.weights, cell.y.weights, cell.z.weights);
}

V3d NoiseTable::gradient(const V3d& p) const {
  const Cell cell(p);
  const auto hashes = cell.hashes();
  return {weighted_sum(hashes, cell.x.derivatives, cell.y.weights, cell.z.weights),
          weighted_sum(hashes, cell.x.weights, cell.y.derivatives, cell.z.weights),
          weighted_sum(hashes, cell.x.weights, cell.y.weights, cell.z.derivatives)};
}

double NoiseTable::turbulence(const V3d& p, int octaves) const {
  double sum = 0;
  double weight = 1;
  V3d q = p;
  for (int k = 0; k < octaves && weight > 0; ++k) {
    sum += weight * noise(q);
    q *= 2.0;
    weight /= 2;
  }
  return sum;
}

const std::shared_ptr<const NoiseTable>& standard_noise() {
  static const auto table = std::make_shared<const NoiseTable>([r = Rand48()]() mutable { return r.next(); });
  return table;
}

}  // namespace farop
