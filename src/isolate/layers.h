// SPDX-License-Identifier: GPL-3.0-or-later
// Words about walls.
#pragma once

#include <cstdint>
#include <vector>

#include "isolate/isolation.h"
#include "isolate/protocol.h"

namespace farop::isolate {

/// Bits of Layer to ask for.
std::uint32_t wanted_layers(const IsolationOptions& options);

/// Whether to put the runner into a control group.
bool wants_group(const IsolationOptions& options);

/// What the runner says that stands, of those asked for: 0 and A to D.
std::vector<IsolationLayer> layers_of(const Hello& hello, std::uint32_t asked);

}  // namespace farop::isolate
