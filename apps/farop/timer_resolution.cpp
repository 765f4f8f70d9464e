// SPDX-License-Identifier: GPL-3.0-or-later
// Highway's library measures the processor's clock for two milliseconds when it is loaded, for a benchmark of
// its own that the program never runs: a sixth of what a small picture takes. The dynamic linker finds this
// function before the library's own. Where the library has no such function, nobody calls this one.
#include <hwy/nanobenchmark.h>

#include <cstdint>

namespace hwy::platform {

std::uint64_t TimerResolution() {
  return 1;
}

}  // namespace hwy::platform
