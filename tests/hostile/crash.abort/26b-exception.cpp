// SPDX-License-Identifier: GPL-3.0-or-later
// Does: throws a C++ exception out of polygon().
// Why:  there is no handler in a C caller: std::terminate, or an unwinder lost in foreign frames.
// also: crash.exit
#include <stdexcept>

#include "../hostile.h"

namespace {
farop_status deed(const farop_polygon*) {
  throw std::runtime_error("edge table is empty");
}
}  // namespace

#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
HOSTILE_PLUGIN(.before = deed)
