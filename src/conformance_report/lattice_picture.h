// SPDX-License-Identifier: GPL-3.0-or-later
// The drawing of an example as SVG: every pixel a square around its integer centre, exact outlines over them.
#pragma once

#include <string>

#include "conformance/result.h"

namespace farop::conformance_report {

/// The part of the frame around the wrong pixels, at most 40 x 40 of them. Wrong pixels differ in shape and
/// colour: missing = hollow diamond, extra = filled square with a cross, others = half square. `row`: marked;
/// -1: none. `title`: read out by screen readers. "" where the example has no picture.
std::string lattice_svg(const conformance::Example& example, int row, const std::string& title);

}  // namespace farop::conformance_report
