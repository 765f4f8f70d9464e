// SPDX-License-Identifier: GPL-3.0-or-later
// The counts of a run.
#pragma once

#include <optional>
#include <span>

#include "conformance/corpus.h"
#include "conformance/result.h"

namespace farop::conformance {

/// Gives the cases of `result` (parallel to the corpus) the verdicts of its findings, and fills its families
/// and the counts and score of its summary.
void sum_up(std::span<const Case> corpus, CheckResult& result);

/// The largest errors that were measured, and what class of rasterizer they make it together with the
/// findings.
Precision precision_of(std::span<const Finding> findings, std::optional<double> worst_depth,
                       std::optional<double> worst_color);

}  // namespace farop::conformance
