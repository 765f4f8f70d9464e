// SPDX-License-Identifier: GPL-3.0-or-later
// Where two drawings of one scene have to look alike.
#pragma once

#include "conformance/expectation.h"

namespace farop::conformance {

/// 1 for each sample of the window, seen in `a`, where `a` and, moved by (shift_x, shift_y), `b` show the
/// background for certain or one polygon for certain, with the same colour at its first corner. For drawings
/// whose polygons have one colour each. Samples beyond either frame are 0.
Bitmap decided_alike(const Expectation& a, const Expectation& b, const Window& window, int shift_x,
                     int shift_y);

}  // namespace farop::conformance
