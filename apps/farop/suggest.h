// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace farop::app {

/// The candidate nearest to a mistyped word (at most a third of its letters wrong, or one it begins), or "".
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace farop::app
