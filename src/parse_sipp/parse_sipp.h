// SPDX-License-Identifier: GPL-3.0-or-later
// Reads scenes that are programs: scripts in Tcl with the commands of SIPP.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostics.h"
#include "scene/scene.h"

namespace farop {

/// What a script may use up. Whichever is reached first ends it with one error.
struct ScriptLimits {
  double seconds = 60;                     ///< by the clock on the wall, > 0
  std::uint64_t memory_mb = 2048;          ///< interpreter and geometry together; 2^20 bytes each
  std::uint64_t commands = 2'000'000'000;  ///< at most 2^31 - 1
  std::uint64_t polygons = 100'000'000;    ///< made by the script, and drawn (instances as often as placed)
  int nesting = 1000;                      ///< levels of procedure calls and evaluations
};

struct SippOptions {
  ScriptLimits limits;
  /// Global variables that are set before the script starts, name and value.
  std::vector<std::pair<std::string, std::string>> variables;
  int capture = 1;  ///< which SippRender of the script makes the scene, from 1
  /// Receives what the script prints, line by line, without LF; at most k_max_script_output bytes in all.
  std::function<void(const std::string&)> log;
};

constexpr std::uint64_t k_max_script_bytes = std::uint64_t{64} << 20;  ///< a file of a script
constexpr std::uint64_t k_max_script_output = std::uint64_t{1} << 20;

/// A name that a script's variable may get from outside: letters, digits and _, no digit first.
bool is_variable_name(std::string_view name);

/// Runs a script up to its render request and returns the scene as it is then: the tree below WORLD as one
/// object under the root, named after the file; lights (the newest first), camera, picture size, drawing
/// mode, background. A script that asks for no rendering gives the scene at its end, with a note. World
/// coordinates, right-handed.
///
/// The script runs in a process of its own that is stopped when it exceeds a limit; it reaches no file but
/// those below the folder of `path` (by `source`), no network, no other program, and leaves nothing behind.
///
/// path     "-" is standard input; its files are those below the working folder
/// returns  nothing after an error was reported to `sink` (the last thing reported)
/// throws   Error(ExitStatus::input) when the file cannot be read, Error(ExitStatus::surroundings) when no
///          process can be started
std::optional<Scene> parse_sipp(const std::string& path, DiagnosticSink& sink,
                                const SippOptions& options = {});

/// The same for a text under a name; its files are those below `folder` (none when that is empty).
std::optional<Scene> parse_sipp_text(std::string_view text, const std::string& name,
                                     const std::string& folder, DiagnosticSink& sink,
                                     const SippOptions& options = {});

/// Runs the text in this process, with no guard but the interpreter's own: for fuzzing, where a crash is what
/// is looked for.
std::optional<Scene> parse_sipp_unguarded(std::string_view text, const std::string& name,
                                          DiagnosticSink& sink, const SippOptions& options = {});

}  // namespace farop
