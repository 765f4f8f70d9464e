// SPDX-License-Identifier: GPL-3.0-or-later
// What repeated measurements say: medians, and how sure of them one can be.
//
// Intervals are percentile bootstraps (B. Efron, "Bootstrap Methods: Another Look at the Jackknife", Annals
// of Statistics 7(1), 1979) with a fixed seed: the same measurements give the same interval.
#pragma once

#include <span>
#include <vector>

namespace farop {

/// The middle one; the mean of the two middle ones of an even number. Not of nothing.
double median(std::vector<double> values);

/// An estimate and the bounds that hold it with 95 % confidence.
struct Estimate {
  double value = 0, low = 0, high = 0;

  bool contains(double v) const { return low <= v && v <= high; }
};

/// How many times as large b is as a: the median of b[i] / a[i]. The two were measured in turns, a[i] and
/// b[i] next to each other, so that a slow moment of the machine hits both. Same size, not empty, values > 0.
Estimate paired_ratio(std::span<const double> a, std::span<const double> b);

/// Exponent p of the growth y ~ x^p: the slope of a least-squares line through log x and the log of the
/// median of y. `samples[i]` are the measurements at x[i], not empty, > 0; at least two different x > 0.
Estimate growth_exponent(std::span<const double> x, std::span<const std::vector<double>> samples);

}  // namespace farop
