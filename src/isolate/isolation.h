// SPDX-License-Identifier: GPL-3.0-or-later
// How far a rasterizer is shut in, and what this machine can do about it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "plugin/host_services.h"

namespace farop {

enum class Isolation {
  automatic,  ///< every wall that the machine offers
  strict,     ///< all of A to D, or Error(ExitStatus::surroundings)
  off         ///< a process of its own, without walls
};

/// What one frame may take. Loading, create() and destroy() count as a frame each.
struct RunnerLimits {
  double cpu_seconds = 60;                              ///< summed over the rasterizer's threads
  double wall_seconds = 305;                            ///< while farop waits for it; catches what sleeps
  std::uint64_t memory_bytes = std::uint64_t{2} << 30;  ///< private memory of the runner
  int threads = 1;  ///< 1: only the one it is called on; more: that many beside it, at a time
};

struct IsolationOptions {
  std::string runner;  ///< path of farop-runner; empty: where this program's installation has it
  Isolation isolation = Isolation::automatic;
  RunnerLimits limits;
  std::map<std::string, std::string> plugin_options;  ///< --plugin-option key=value
  /// No-man's-land behind the vertices of every single polygon, and none of them can be looked at once its
  /// polygon() has returned. Slow: for checks. Otherwise so for every quarter of a megabyte of polygons.
  bool guard_every_polygon = false;
  bool check = false;  ///< a PluginCheck stands before the rasterizer
  /// Byte (or its complement) that memory fresh from malloc is filled with; 0: as it comes. Shows who reads
  /// what he never wrote.
  std::uint8_t fresh_memory = 0;
  std::uint64_t seed = 1;  ///< of the random bytes around and between the rows
  PluginLog log;           ///< lines that the rasterizer logs, safe to print
  std::string without;     ///< layers not to use, by letter ("BC"): for tests of what the others do alone
  std::string group_root;  ///< see ControlGroup: for tests, too
};

/// What a rasterizer did wrong: what ended a run, or spoiled it.
struct PluginFinding {
  /// crash.*, oob.*, limit.*, abi.*: the verdicts of `farop check`.
  std::string verdict;
  bool fatal = false;    ///< the process is gone; the next frame starts a new one
  bool warning = false;  ///< to be shown, but right pictures stay right
  bool of_host = false;  ///< FAROP's own fault (harness.error)
  std::string message;   ///< one line: "null pointer: it read address 0 in polygon 2 (3 corners, ...)"
  std::string hint;      ///< the remedy, or empty
  std::optional<std::uint32_t> polygon;  ///< number within the frame, from 0
  std::vector<std::string> trace;        ///< "fill_row+0x1c", innermost first; hints, not proof
};

/// A finding that leaves no picture.
class PluginFailure : public Error {
 public:
  /// `name`: of the rasterizer, for the message; or of its file.
  PluginFailure(const std::string& name, PluginFinding finding);
  const PluginFinding& finding() const { return finding_; }

 private:
  PluginFinding finding_;
};

/// One wall around the runner.
struct IsolationLayer {
  std::string id;      ///< "0 process", "A limits", "B namespaces", "C landlock", "D seccomp", "E cgroup"
  bool holds = false;  ///< tried just now, and it stopped what it should stop
  std::string why;     ///< why not; or what is special
  std::string how_to_enable;  ///< empty when it holds, or nothing can be done
};

/// A line for the user: which of the walls A to D are missing, and why. Empty: none. (Layer E is to be had in
/// few places; `farop doctor` has it.)
std::string missing_walls(const std::vector<IsolationLayer>& layers);

/// Tries every layer with a harmless probe in a process of its own: for `farop doctor`. Throws
/// Error(ExitStatus::surroundings) when the runner cannot be started at all.
std::vector<IsolationLayer> probe_isolation(const std::string& runner = {});

/// The runner of this installation: ../libexec/farop of the program's folder, or beside it in a build tree.
/// Throws Error(ExitStatus::surroundings) when it is not there.
std::string find_runner();

}  // namespace farop
