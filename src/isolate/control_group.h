// SPDX-License-Identifier: GPL-3.0-or-later
// Layer E: a control group (cgroup v2) of its own for a runner, where the machine has delegated one.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

#include "isolate/isolation.h"

namespace farop::isolate {

/// A group beside the one that this process is in, or below it: wherever the controllers for memory and
/// processes are switched on and a folder may be made. Nothing is switched on that was not before. Limits
/// count for all processes of the group together, also those of root, and count memory that is shared.
/// Removed with whatever is in it by the destructor.
class ControlGroup {
 public:
  struct Limits {
    std::uint64_t memory_bytes = 0;  ///< 0: no limit
    std::uint32_t tasks = 1;         ///< processes and threads
  };
  /// `root` stands before every path, of /proc and of the mounted file system: a folder with copies, for
  /// tests.
  explicit ControlGroup(const Limits& limits, const std::string& root = "");
  ~ControlGroup();
  ControlGroup(const ControlGroup&) = delete;
  ControlGroup& operator=(const ControlGroup&) = delete;

  /// False: there is none, for the reason in why().
  bool there() const { return !path_.empty(); }
  const std::string& why() const { return why_; }
  const std::string& path() const { return path_; }

  /// Moves a process in. False: it stays where it was, why() has the reason.
  bool add(pid_t process);
  /// Processes of the group that the kernel killed for want of memory.
  std::uint64_t killed_for_memory() const;
  /// Most memory that the group had at a time, where the kernel says so (Linux 5.19).
  std::optional<std::uint64_t> peak_bytes() const;
  /// Kills what is in it and removes it; waits for that, at most half a second. False: it is still there.
  bool remove();

 private:
  bool set(const char* file, const std::string& value);

  std::string path_;
  std::string why_;
};

/// Makes a group for one task, puts a child in it and has it try to start another one.
IsolationLayer probe_control_group(const std::string& root = "");

/// The layer as a report has it: "E cgroup".
IsolationLayer control_group_layer(bool holds, const std::string& why);

}  // namespace farop::isolate
