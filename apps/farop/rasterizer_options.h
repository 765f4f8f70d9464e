// SPDX-License-Identifier: GPL-3.0-or-later
// Which rasterizer draws: the options, and finding it by name.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "isolate/isolation.h"

namespace farop::app {

struct RasterizerOptions {
  std::string name = "internal";        ///< "internal", "null", "scanline", one that is looked up, a file
  std::string command;                  ///< --cmd
  std::vector<std::string> key_values;  ///< --plugin-option K=V
  std::vector<std::string> folders;     ///< -I
  /// Of the internal rasterizer, 0: as many as the machine gives; those a library may have, 0 and 1: no
  /// other.
  int threads = 0;
  bool in_process = false;
  bool check = false;
  std::string isolation = "auto";
  std::optional<double> cpu_seconds, wall_seconds;  ///< per frame
  std::optional<double> memory_megabytes;
};

/// Adds the group "Rasterizer".
void add_rasterizer_options(CLI::App& command, RasterizerOptions& options);

/// What is to draw.
enum class RasterizerKind { internal, null, library, command };
struct ChosenRasterizer {
  RasterizerKind kind = RasterizerKind::internal;
  std::string file;     ///< of a library: as given, or where it was found
  std::string command;  ///< of --cmd
};

/// Looks a name up: the built-in ones; a file when it has a slash or ends in .so or .py; else NAME.so,
/// libNAME.so or NAME.py in the folders of -I, of FAROP_PLUGIN_PATH (separated by colons) and of the
/// installation, in this order. Throws Error(usage) for options that contradict each other, Error(plugin)
/// with near names when nothing is found.
ChosenRasterizer choose_rasterizer(const RasterizerOptions& options);

/// --plugin-option K=V as a table. Throws Error(usage).
std::map<std::string, std::string> plugin_options(const RasterizerOptions& options);

/// What is loaded for a chosen file: the library itself, or for a Python script the adapter, which gets the
/// script as two options more. Throws Error(plugin) when the script cannot be read.
struct LoadableRasterizer {
  std::string library;
  std::map<std::string, std::string> options;
};
LoadableRasterizer loadable(const std::string& file, std::map<std::string, std::string> options);

/// How far a library is shut in, as the options say; `log` gets what it logs. Throws Error(usage).
IsolationOptions isolation_options(const RasterizerOptions& options, PluginLog log);

/// Folders that are searched, in order, whether they exist or not.
std::vector<std::filesystem::path> plugin_folders(const std::vector<std::string>& first);

/// Libraries in those folders, in the order of the search; a name that was met before is left out.
struct FoundLibrary {
  std::string name;  ///< as --rasterizer takes it
  std::filesystem::path file;
};
std::vector<FoundLibrary> find_libraries(const std::vector<std::string>& first_folders);

}  // namespace farop::app
