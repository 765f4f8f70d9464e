// SPDX-License-Identifier: GPL-3.0-or-later
// Frame memory -> PPM (P6), without any library.
#pragma once

#include <string>

#include "core/framebuffer.h"

namespace farop {

/// True for what is written as PPM: `.ppm`, `.pnm`, "-" (standard output), and targets that are no regular
/// files (pipes, devices), whatever their names.
bool is_ppm_path(const std::string& path);

/// Writes the colours of `picture`, top row first. Throws Error(ExitStatus::surroundings) when the file
/// cannot be written; an older file is then untouched.
void write_ppm(const std::string& path, const Framebuffer& picture);

}  // namespace farop
