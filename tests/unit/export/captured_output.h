// SPDX-License-Identifier: GPL-3.0-or-later
// What a writer sends to a pipe or to standard output.
#pragma once

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <future>
#include <string>

#include "test_files.h"

namespace farop::test {

/// Calls write(path of a named pipe) and returns what came out of it.
template <typename Write>
std::string through_pipe(const TemporaryFolder& folder, const std::string& name, const Write& write) {
  const std::string path = folder / name;
  if (::mkfifo(path.c_str(), 0600) != 0) std::abort();
  auto reader = std::async(std::launch::async, [&path] { return file_bytes(path); });
  write(path);
  std::string bytes = reader.get();
  std::filesystem::remove(path);
  return bytes;
}

/// Calls write("-") with standard output turned to a file and returns what the file holds.
template <typename Write>
std::string through_stdout(const TemporaryFolder& folder, const Write& write) {
  std::fflush(stdout);
  const int old = ::dup(STDOUT_FILENO);
  const std::string path = folder / "stdout";
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ::dup2(::fileno(file), STDOUT_FILENO);
  write("-");
  ::dup2(old, STDOUT_FILENO);
  ::close(old);
  std::fclose(file);
  std::string bytes = file_bytes(path);
  std::filesystem::remove(path);
  return bytes;
}

}  // namespace farop::test
