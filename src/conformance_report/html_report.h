// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "conformance/result.h"
#include "conformance_report/catalogue.h"

namespace farop::conformance_report {

/// The whole report as one HTML page: no network, no other files, below 10 MB; pictures that would exceed
/// that are left out, which the page says. Readable without JavaScript; with it, pictures can be inspected
/// pixel by pixel. All text of the result is escaped. `words`: the language of what the page says itself; the
/// result should be translated() already.
std::string to_html(const conformance::CheckResult& result, const Catalogue& words);

}  // namespace farop::conformance_report
