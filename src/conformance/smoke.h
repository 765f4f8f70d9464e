// SPDX-License-Identifier: GPL-3.0-or-later
// Family smoke: does it draw at all, the right way round, in the right colours?
#pragma once

#include <optional>
#include <span>
#include <string>

#include "conformance/run.h"

namespace farop::conformance {

/// Runs the cases of the family, whose `rows` (parallel to the corpus) are filled. What has to be undone in
/// every picture is told to `run`. A text: the reason why the rest is not worth running.
std::optional<std::string> run_smoke(Run& run, std::span<const Case> corpus, std::span<CaseResult> rows,
                                     Outcome& out);

}  // namespace farop::conformance
