// SPDX-License-Identifier: GPL-3.0-or-later
// Does: exports a variable by the name of the entry.
// Why:  calling it executes data.
// also: crash.segv, abi.symbol
#include "../hostile.h"

// Not the declaration of the interface: a C file sees both, the loader only the name.
__attribute__((visibility("default"))) const int entry_data __asm__("farop_rasterizer_entry") = 1;
