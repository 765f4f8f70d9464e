// SPDX-License-Identifier: GPL-3.0-or-later
// Where the parts of the installation are, wherever it was moved to.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace farop::app {

/// A file of the library folder: <prefix>/lib/farop/NAME beside the running program, or lib/farop/NAME of its
/// build folder. The first of these that exists; the installed place when none does.
std::filesystem::path library_file(const std::string& name);

/// A file or folder of the data folder: <prefix>/share/farop/NAME, or share/farop/NAME of the build folder.
std::filesystem::path data_file(const std::string& name);

/// The folder to give to a compiler, so that it finds farop/rasterizer.h: of the installation, or of the
/// source tree when the program runs from its build folder.
std::filesystem::path include_folder();

/// Where the shell would find a program, or "".
std::string program_in_path(std::string_view name);

}  // namespace farop::app
