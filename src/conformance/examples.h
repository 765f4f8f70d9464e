// SPDX-License-Identifier: GPL-3.0-or-later
// The smallest drawings that show a finding.
#pragma once

#include <vector>

#include "conformance/run.h"

namespace farop::conformance {

/// Adds up to three examples, simplest first; the first one is shrunk where that can be done.
void add_examples(Run& run, Finding& finding, std::vector<const Problem*> members);

}  // namespace farop::conformance
