// SPDX-License-Identifier: GPL-3.0-or-later
// From the way a process ended to words for the author of the rasterizer.
#pragma once

#include <farop/rasterizer.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "isolate/isolation.h"
#include "isolate/protocol.h"

namespace farop::isolate {

/// What is known here about the time of an end.
struct Circumstances {
  const BlackBox* box = nullptr;         ///< a copy; hints of the runner
  const farop_frame* frame = nullptr;    ///< the current one; nullptr: none
  std::optional<std::uint32_t> corners;  ///< of the current polygon
  std::optional<farop_vertex> first_corner;
  std::string last_error_line;     ///< that it printed
  std::uint64_t memory_bytes = 0;  ///< limit
  bool walled = false;             ///< it could not send itself SIGKILL
};

/// Nothing: it was not the rasterizer's doing as far as we know (killed from outside).
std::optional<PluginFinding> finding_of_end(int wait_status, const Circumstances& circumstances);
/// For one that the kernel ended as its control group had no memory left.
PluginFinding finding_of_memory(const Circumstances& circumstances);
/// For a time limit.
PluginFinding finding_of_time(bool cpu, double seconds, const Circumstances& circumstances);
/// For a system call that was refused.
PluginFinding finding_of_refusal(const WardenMessage& refusal);

/// "in polygon 2 (3 corners, first at 10, 20)", "in begin_frame", "while it was loaded". `polygon` gets the
/// number where there is one.
std::string where_text(const Circumstances& circumstances, std::optional<std::uint32_t>* polygon = nullptr);

}  // namespace farop::isolate
