// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sample_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace farop {
namespace {

constexpr int k_resamples = 2000;

/// Random numbers that are the same with every standard library.
class Resampler {
 public:
  std::size_t index(std::size_t size) { return static_cast<std::size_t>(engine_() % size); }

  /// As many values as there are, drawn with replacement.
  std::vector<double> draw(std::span<const double> values) {
    std::vector<double> drawn;
    drawn.reserve(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) drawn.push_back(values[index(values.size())]);
    return drawn;
  }

 private:
  std::mt19937_64 engine_{20260101};
};

Estimate with_interval(double value, std::vector<double> resampled) {
  std::sort(resampled.begin(), resampled.end());
  const auto at = [&](double fraction) {
    return resampled[static_cast<std::size_t>(
        std::lround(fraction * static_cast<double>(resampled.size() - 1)))];
  };
  return {value, at(0.025), at(0.975)};
}

double slope(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mean_x += x[i] / n, mean_y += y[i] / n;
  double xy = 0, xx = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    xx += (x[i] - mean_x) * (x[i] - mean_x);
  }
  return xy / xx;
}

}  // namespace

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 != 0) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

Estimate paired_ratio(std::span<const double> a, std::span<const double> b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(b[i] / a[i]);
  Resampler resampler;
  std::vector<double> medians;
  medians.reserve(k_resamples);
  for (int i = 0; i < k_resamples; ++i) medians.push_back(median(resampler.draw(ratios)));
  return with_interval(median(ratios), std::move(medians));
}

Estimate growth_exponent(std::span<const double> x, std::span<const std::vector<double>> samples) {
  std::vector<double> log_x;
  for (const double v : x) log_x.push_back(std::log(v));
  const auto fit = [&](auto&& choose) {
    std::vector<double> log_y;
    for (const std::vector<double>& of_size : samples) log_y.push_back(std::log(median(choose(of_size))));
    return slope(log_x, log_y);
  };
  Resampler resampler;
  std::vector<double> slopes;
  slopes.reserve(k_resamples);
  for (int i = 0; i < k_resamples; ++i) {
    slopes.push_back(fit([&](const std::vector<double>& values) { return resampler.draw(values); }));
  }
  return with_interval(fit([](const std::vector<double>& values) { return values; }), std::move(slopes));
}

}  // namespace farop
