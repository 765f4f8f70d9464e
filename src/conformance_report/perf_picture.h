// SPDX-License-Identifier: GPL-3.0-or-later
// A curve of family perf as SVG: time against size, both as logarithms.
#pragma once

#include <string>

#include "conformance/result.h"

namespace farop::conformance_report {

/// "" where there are fewer than two points. `title` is read out by screen readers; safe in an attribute.
std::string perf_svg(const conformance::PerfResult& perf, const std::string& title);

/// What grows in a measurement, in English: "area of one polygon"; the name itself where it is not known.
std::string what_grows(const std::string& name);

}  // namespace farop::conformance_report
