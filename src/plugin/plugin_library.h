// SPDX-License-Identifier: GPL-3.0-or-later
// A rasterizer as a shared library: opened, checked, ready to be called. The only place that knows dlopen.
#pragma once

#include <farop/rasterizer.h>

#include <cstddef>
#include <string>

#include "plugin/host_services.h"

namespace farop {

/// What went wrong while loading, apart from the words: the verdicts of a check.
enum class LoadFailure {
  none,
  file,      ///< not there, not a library for this machine, something it needs is missing
  symbol,    ///< no farop_rasterizer_entry
  refused,   ///< the entry returned NULL
  version,   ///< another major version of the interface
  contract,  ///< table too small, a required function is NULL, an unknown wish, an impossible name
};

/// A loaded rasterizer. Nothing is ever unloaded: thread-local destructors and the like may point into the
/// library until the process ends.
struct PluginLibrary {
  const farop_rasterizer* table = nullptr;  ///< nullptr: failed
  std::string name;                         ///< the table's, safe to print
  std::string summary;                      ///< one line, safe to print
  LoadFailure failure = LoadFailure::none;
  std::string message;  ///< of the failure: one line, without the file's name
  std::string hint;     ///< the remedy, or empty
  std::string warning;  ///< loaded, but it changed what it should not have (floating-point state)
};

/// Opens `path` (anything that dlopen takes), calls its entry and looks at its table. Runs the library's own
/// code.
PluginLibrary open_plugin(const std::string& path, HostServices& services);

/// Text of a rasterizer's table that open_plugin() is reading, or nullptr: whoever looks after a crash learns
/// that it was text without an end.
extern const char* volatile plugin_text_in_hand;

/// The checks of open_plugin() on a table that is at hand, for rasterizers that are linked in.
PluginLibrary check_plugin_table(const farop_rasterizer* table);

/// First look at a file without running anything of it: a regular ELF shared library for this machine, of
/// bearable size. A PluginLibrary with a failure, or with failure none.
PluginLibrary inspect_plugin_file(const std::string& path);

/// Words for a status that a rasterizer returned: "out of memory (FAROP_E_MEMORY)".
std::string status_text(farop_status status);

}  // namespace farop
