// SPDX-License-Identifier: GPL-3.0-or-later
// What looks wrong, drawn once more: does it come out the same in another life?
#pragma once

#include <string>

#include "conformance/run.h"

namespace farop::conformance {

/// One piece of evidence alone, in a small frame.
Drawing alone(const Evidence& evidence);

/// Draws twice in a new life: right at first and wrong then means that a frame leaves something behind, which
/// is noted in `out`.
bool leaves_state_behind(Run& run, const std::string& case_id, const Drawing& given, Outcome& out);

/// Pictures differ between lives whose fresh memory holds different bytes.
bool depends_on_memory(Run& run, const Drawing& given);

/// The same for the first few witnesses of wrong coverage; `all` holds the evidence and gets the problem.
bool carries_state(Run& run, const CoverageCause& cause, Outcome& all);

/// Every wrong case, or the first few, come out right alone.
bool does_not_repeat(Run& run, const CoverageCause& cause, const Outcome& all);

}  // namespace farop::conformance
