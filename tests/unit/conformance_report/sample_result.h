// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "conformance/result.h"

namespace farop::conformance_report {

/// A failing run made by hand: a triangle with a missing and an extra pixel, a crash, a skip; the rasterizer
/// is called
/// "<script>" and prints control characters.
conformance::CheckResult sample_result();

}  // namespace farop::conformance_report
