// SPDX-License-Identifier: GPL-3.0-or-later
// From the problems of single cases to findings, each of one cause.
#pragma once

#include <vector>

#include "conformance/run.h"

namespace farop::conformance {

/// Gives provisional verdicts their final names, drops what follows from the cause of wrong coverage, and
/// puts that cause in front.
void name_problems(const Run& run, const CoverageCause& cause, Outcome& all);

/// One finding for all problems of one verdict, detail and severity, with examples; errors first.
std::vector<Finding> findings_of(Run& run, const std::vector<Problem>& problems);

}  // namespace farop::conformance
