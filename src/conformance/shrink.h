// SPDX-License-Identifier: GPL-3.0-or-later
// From a drawing that fails to the smallest one that still does.
//
// Source: Zeller & Hildebrandt, "Simplifying and isolating failure-inducing input", IEEE TSE 28(2), 2002.
#pragma once

#include <functional>

#include "conformance/drawing.h"

namespace farop::conformance {

struct ShrinkBudget {
  int renders = 400;
  double seconds = 2;
};

/// `fails` says whether a drawing shows the same verdict; it may be asked `budget.renders` times. Drops
/// polygons, then corners, moves towards the origin, halves coordinates and simplifies depths and colours.
/// Returns the smallest failing drawing met; `renders` counts the questions.
Drawing shrunk(Drawing drawing, const std::function<bool(const Drawing&)>& fails, const ShrinkBudget& budget,
               int& renders);

}  // namespace farop::conformance
