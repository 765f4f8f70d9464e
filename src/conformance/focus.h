// SPDX-License-Identifier: GPL-3.0-or-later
// From a scene to the few of its polygons that a wrong sample needs.
#pragma once

#include "conformance/problem.h"
#include "conformance/run.h"

namespace farop::conformance {

/// Where a problem's drawing is large: draws the polygons around one of its wrong samples alone, and keeps
/// just those where that sample is wrong again in the same way. The numbers of wrong samples stay.
void focus(Run& run, Subject& subject, Problem& problem);

}  // namespace farop::conformance
