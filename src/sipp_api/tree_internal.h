// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "library_internal.h"

namespace farop::sipp_api {

/// Throws Error(ExitStatus::input) for an object that contains itself or lies more than sipp::k_max_depth
/// levels deep.
void check_tree(const ::Object& top);

/// Everything counts as often as it is placed. `top` has passed check_tree().
struct TreeCount {
  double objects = 0, polygons = 0;
};
TreeCount count_tree(const ::Object& top);

}  // namespace farop::sipp_api
