// SPDX-License-Identifier: GPL-3.0-or-later
// The walls around a rasterizer, each on its own. All return 0 or an errno.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "isolate/protocol.h"

namespace farop::isolate {

/// An id that owns nothing, for a runner that would otherwise be root.
constexpr uid_t k_nobody = 65534;

/// Becomes k_nobody for good, when root. Capabilities go in any case.
int give_up_privileges();

/// Gives up all capabilities, those that a user namespace lends included.
int drop_capabilities();

/// Layer A. Memory: private writable pages; address space somewhat more, for what is only reserved.
int limit_resources(std::uint64_t memory_bytes, std::uint32_t threads);

/// Layer B, in the warden: namespaces for its children (processes, mounts, network, IPC, host name) and a
/// root file system of nothing but library folders and, as /rasterizer.so, the library. The warden itself
/// stays in the outer process namespace. Negative: an errno after which there is no way back to a state in
/// which a library could be loaded.
int enter_namespaces(int library_fd);
/// Where enter_namespaces() puts the library.
constexpr const char* k_library_inside = "/rasterizer.so";

/// Layer C: files can be read in library folders only; no TCP; signals and abstract sockets stay inside.
/// `abi` gets the version that the kernel speaks, 0 when none.
int restrict_files(std::int32_t& abi);

/// Layer D, before anything of the rasterizer runs. With `watched` calls that are worth a word are handed to
/// whoever holds `listener`, which then is a descriptor; without, they fail silently and `listener` is -1.
int filter_calls(std::uint32_t threads, bool watched, int& listener);

/// Layer D, once the rasterizer is loaded: no file names any more, no new code, no new filters.
int filter_calls_further(bool watched);

/// What a call was after that filter_calls() handed over; `fatal`: no program calls this by accident.
struct Refusal {
  Deed deed = Deed::kernel;
  bool fatal = false;
};
Refusal refusal_of(int call);
/// "clone", or "call 1234".
std::string call_name(int call);

}  // namespace farop::isolate
