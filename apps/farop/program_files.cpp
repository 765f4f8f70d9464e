// SPDX-License-Identifier: GPL-3.0-or-later
#include "program_files.h"

#include <unistd.h>

#include <cstdlib>
#include <system_error>

#include "version.h"

namespace farop::app {

namespace fs = std::filesystem;

namespace {

fs::path program_folder() {
  std::error_code ec;
  return fs::read_symlink("/proc/self/exe", ec).parent_path();
}

}  // namespace

fs::path library_file(const std::string& name) {
  std::error_code ec;
  fs::path in_build_folder = program_folder() / "lib" / "farop" / name;
  if (fs::exists(in_build_folder, ec)) return in_build_folder;
  return (program_folder() / k_bin_to_lib / "farop" / name).lexically_normal();
}

fs::path data_file(const std::string& name) {
  std::error_code ec;
  fs::path in_build_folder = program_folder() / "share" / "farop" / name;
  if (fs::exists(in_build_folder, ec)) return in_build_folder;
  return (program_folder() / k_bin_to_data / "farop" / name).lexically_normal();
}

fs::path include_folder() {
  std::error_code ec;
  fs::path in_build_folder = program_folder() / "include";
  if (fs::exists(in_build_folder / "farop" / "rasterizer.h", ec)) return in_build_folder;
  return (program_folder() / k_bin_to_include).lexically_normal();
}

std::string program_in_path(std::string_view name) {
  const char* const path = std::getenv("PATH");
  for (std::string_view rest = path == nullptr ? "" : path; !rest.empty();) {
    const std::size_t colon = rest.find(':');
    const fs::path candidate = fs::path(rest.substr(0, colon)) / name;
    std::error_code ec;
    if (::access(candidate.c_str(), X_OK) == 0 && !fs::is_directory(candidate, ec)) return candidate;
    rest = colon == std::string_view::npos ? std::string_view() : rest.substr(colon + 1);
  }
  return "";
}

}  // namespace farop::app
