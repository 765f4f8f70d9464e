// SPDX-License-Identifier: GPL-3.0-or-later
// Where and with what a run took place: for reports that are read elsewhere, later.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace farop::app {

/// SHA-256 of a file's bytes, 64 hexadecimal digits; "" where it cannot be read.
std::string sha256_of_file(const std::string& path);
/// That built this program: "gcc 12.2.0".
std::string compiler_name();
/// "Linux 6.1.0 x86_64"
std::string system_name();
/// "AMD EPYC 7763, 4 processors"; without the name where the system does not tell.
std::string processor_name();
/// UTC, ISO 8601, in whole seconds.
std::string time_now();

/// What a rasterizer prints in the course of many frames: every line once, with how often it came, within
/// limits. Any thread may add.
class PrintedLines {
 public:
  void add(const std::string& line);
  std::string text() const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::pair<std::string, std::uint64_t>> lines_;
  std::uint64_t left_out_ = 0;
};

}  // namespace farop::app
