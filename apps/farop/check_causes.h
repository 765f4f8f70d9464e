// SPDX-License-Identifier: GPL-3.0-or-later
// Causes that one run of the checker cannot see: what fails is run again under other conditions.
#pragma once

#include <vector>

#include "conformance/check.h"
#include "rasterizer_options.h"
#include "session.h"

namespace farop::app {

/// How the run was made that is to be explained.
struct CheckedRun {
  Session& session;
  const ChosenRasterizer& chosen;
  const RasterizerOptions& how;
  conformance::CheckOptions options;
  std::uint64_t seed = 1;
};

/// Turns det.rerun and det.fill into det.threads where the same cases repeat, or are not drawn at all, when
/// the rasterizer may start no threads.
void blame_threads(const CheckedRun& run, const std::vector<conformance::Case>& cases,
                   conformance::CheckResult& result);

/// Adds a note where `usual`, the same cases under the seed that everybody knows, pass: the answers depend on
/// the seed.
void note_seed_dependence(const CheckedRun& run, const std::vector<conformance::Case>& usual,
                          conformance::CheckResult& result);

}  // namespace farop::app
