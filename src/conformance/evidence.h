// SPDX-License-Identifier: GPL-3.0-or-later
// From samples that single polygons were seen to cover to the rule, or the slip, behind them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "conformance/fill_rules.h"
#include "conformance/result.h"

namespace farop::conformance {

/// Which samples one polygon (in one or several pieces of one colour) was seen to cover.
struct Evidence {
  std::string case_id, name;          ///< "cov/tri4#7@1", "tri4"
  std::vector<TestPolygon> polygons;  ///< as given
  Bitmap got;                         ///< of a window around them
  std::uint64_t far_away = 0;         ///< samples of its colour outside that window
  std::uint64_t wrong = 0;            ///< against the required rule; filled by name_coverage()
};

struct CoverageCause {
  std::string verdict, detail, message, hint;
  std::uint64_t wrong = 0, explained = 0;
  std::vector<std::size_t> witnesses;  ///< wrong evidence, simplest first
  bool exact = false;                  ///< it explains everything, and nothing else
  bool consistent = false;             ///< another consistent rule, under which all else can be judged
  ConsistentRule rule = ConsistentRule::lb;
};

/// Samples that differ from what the required rule covers.
std::uint64_t wrong_samples(const Evidence& evidence);

/// Fills `wrong` everywhere. An empty verdict: nothing is wrong.
CoverageCause name_coverage(std::vector<Evidence>& evidence);

/// Which boundary samples were drawn.
std::vector<FingerprintRow> fingerprint(const std::vector<Evidence>& evidence);

}  // namespace farop::conformance
