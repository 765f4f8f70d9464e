// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "conformance/result.h"

namespace farop::conformance_report {

/// The whole report as one HTML page: no network, no other files, below 10 MB; pictures that would exceed
/// that are left out, which the page says. Readable without JavaScript; with it, pictures can be inspected
/// pixel by pixel. All text of the result is escaped.
std::string to_html(const conformance::CheckResult& result);

}  // namespace farop::conformance_report
