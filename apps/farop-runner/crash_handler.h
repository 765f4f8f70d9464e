// SPDX-License-Identifier: GPL-3.0-or-later
// Writes down what can be said about a crash before the process dies of it.
#pragma once

#include <cstdint>
#include <string>

#include "isolate/protocol.h"

namespace farop::isolate {

/// Memory whose neighbourhood is known: [first, end) is reserved, of which [begin, begin + bytes) may be
/// used.
struct KnownMemory {
  std::uintptr_t first = 0, end = 0;
  std::uintptr_t begin = 0;
  std::uint64_t bytes = 0;
  bool live = false;
};

constexpr int k_old_frames = 8;  ///< that stay reserved, so that late writes hit nothing

/// What the handler looks addresses up in. Filled by the runner.
struct KnownMemories {
  KnownMemory frame;
  KnownMemory old_frames[k_old_frames];
  KnownMemory chunks[k_ring_slots + 1];  ///< the last: one with a memory of its own
};
extern KnownMemories g_known;

/// Installs the handlers, on a stack of their own, and the terminate handler. `box` outlives the process.
void install_crash_handler(BlackBox* box, std::uint64_t memory_bytes);

/// Puts handlers and the signal mask back where somebody changed them. Bits of ReplyWarning.
std::uint32_t restore_signals();

/// Reads the names of the library's functions, before it is loaded.
void read_symbols(int library_fd);

/// Notes where libraries lie, once the rasterizer is loaded as `path`.
void note_modules(const std::string& path);

/// Ends the process because pthread_exit() left the rasterizer.
[[noreturn]] void die_of_thread_exit();

/// True when there is hardly any memory left below the limit.
bool memory_is_refused();

}  // namespace farop::isolate
