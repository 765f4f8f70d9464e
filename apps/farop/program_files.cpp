// SPDX-License-Identifier: GPL-3.0-or-later
#include "program_files.h"

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

}  // namespace farop::app
