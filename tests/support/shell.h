// SPDX-License-Identifier: GPL-3.0-or-later
// Runs command lines in a folder of their own, as a user types them.
#pragma once

#include <filesystem>
#include <string>

namespace farop::test {

/// A fresh folder that is removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

struct Outcome {
  int status = -1;  ///< exit status of the shell; 124 = it took longer than the time limit
  std::string out, err;
};

/// Runs `command` with bash (pipefail set) in `folder`, with the program under test as `farop` in the PATH,
/// no standard input unless the command redirects it, no FAROP_ variables, and a time limit of 120 seconds.
Outcome shell(const TemporaryFolder& folder, const std::string& command);

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace farop::test
