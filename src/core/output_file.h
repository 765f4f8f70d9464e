// SPDX-License-Identifier: GPL-3.0-or-later
// Output that is complete or not there at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace farop {

/// A file that is written under a temporary name in the target's own folder and takes its name in commit().
/// When it is destroyed without commit() nothing is left behind and an older file of that name is untouched.
/// "-" is standard output; an existing target that is no regular file (a pipe, a device) is written in place.
/// All members throw Error(ExitStatus::surroundings) with the path and the system's reason.
class OutputFile {
 public:
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  /// Overwrites bytes written earlier. Only when seekable().
  void write_at(std::uint64_t offset, std::string_view bytes);
  bool seekable() const { return seekable_; }
  std::uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }
  void commit();

 private:
  [[noreturn]] void fail(const char* what, int error_number) const;

  std::string path_;
  std::string temporary_path_;  ///< empty when written in place
  int descriptor_ = -1;
  bool seekable_ = false;
  bool owns_descriptor_ = true;
  std::uint64_t size_ = 0;
};

}  // namespace farop
