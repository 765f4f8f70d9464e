// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

namespace farop {

/// Called now and then during long work: `done` of `total` units; total 0 = not known. May be empty.
using ProgressFunction = std::function<void(std::uint64_t done, std::uint64_t total)>;

}  // namespace farop
