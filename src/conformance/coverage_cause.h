// SPDX-License-Identifier: GPL-3.0-or-later
// Between the families about coverage and the others: why is coverage wrong, and how to judge all else then?
#pragma once

#include "conformance/run.h"

namespace farop::conformance {

/// Names the cause of all wrong coverage in `all` and tells `run` and the fingerprint and notes of `result`.
/// False: there is no point in going on.
bool name_coverage_cause(Run& run, Outcome& all, CoverageCause& cause, CheckResult& result);

}  // namespace farop::conformance
