// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "conformance/result.h"
#include "conformance_report/catalogue.h"

namespace farop::conformance_report {

/// What farop check prints: one line per finding for programs, the same in any language; then sentences, the
/// worst case as cells of two characters (in its colours where `colored`), and counts. `words` as for
/// to_html().
std::string to_terminal(const conformance::CheckResult& result, const Catalogue& words, bool colored);

}  // namespace farop::conformance_report
