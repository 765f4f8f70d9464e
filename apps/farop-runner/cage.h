// SPDX-License-Identifier: GPL-3.0-or-later
// Inside the walls: loads the rasterizer and calls it as the judge asks.
#pragma once

#include "isolate/protocol.h"

namespace farop::isolate {

/// The runner, from the first of the remaining walls to its end. `namespaces`: 0, or the errno why layer B
/// does not stand. Never returns.
[[noreturn]] void run_cage(const Settings& settings, const char* options, int namespaces);

}  // namespace farop::isolate
