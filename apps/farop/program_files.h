// SPDX-License-Identifier: GPL-3.0-or-later
// Where the parts of the installation are, wherever it was moved to.
#pragma once

#include <filesystem>
#include <string>

namespace farop::app {

/// A file of the library folder: <prefix>/lib/farop/NAME beside the running program, or lib/farop/NAME of its
/// build folder. The first of these that exists; the installed place when none does.
std::filesystem::path library_file(const std::string& name);

}  // namespace farop::app
