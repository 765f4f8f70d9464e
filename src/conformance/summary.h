// SPDX-License-Identifier: GPL-3.0-or-later
// The counts of a run.
#pragma once

#include <span>

#include "conformance/corpus.h"
#include "conformance/result.h"

namespace farop::conformance {

/// Gives the cases of `result` (parallel to the corpus) the verdicts of its findings, and fills its families
/// and the counts and score of its summary.
void sum_up(std::span<const Case> corpus, CheckResult& result);

}  // namespace farop::conformance
