// SPDX-License-Identifier: GPL-3.0-or-later
// Frame memory -> picture file, by file extension.
//
// Linear values go out as they are: no gamma, no colour profile. 8-bit formats hold the bytes of the frame
// memory, floating-point formats (EXR, HDR) c/255. Top row first. Nothing in a file tells when or by what it
// was written, so equal pictures make equal files. A file is complete or not there at all
// (core/output_file.h).
#pragma once

#include <string>

#include "core/framebuffer.h"

namespace farop {

/// Throws Error(ExitStatus::usage) when write_image() would not know how to write `path`: to be asked before
/// the work that makes the picture.
void check_image_path(const std::string& path);

/// Writes the colours of `picture`: PPM as write_ppm() does (export/ppm_writer.h). PNG, EXR, TIFF, JPEG, BMP,
/// TGA, WebP, HDR, GIF and DPX are written by OpenImageIO, under all extensions it knows for them; JPEG,
/// WebP, HDR and GIF keep colours nearly, the others exactly. Throws as check_image_path();
/// Error(ExitStatus::usage) also when the format cannot hold the picture (too large, say);
/// Error(ExitStatus::surroundings) when the file cannot be written, an older file is then untouched.
void write_image(const std::string& path, const Framebuffer& picture);

/// Throws Error(ExitStatus::usage) when `path` is neither an EXR nor a TIFF.
void check_depth_path(const std::string& path);

/// Writes the depths of `picture`, which must not be empty, as one channel of 32-bit floats named Z: the
/// integer z as it is, ZRES where nothing opaque was drawn. EXR or TIFF, by extension. Throws as
/// write_image().
void write_depth(const std::string& path, const Framebuffer& picture);

}  // namespace farop
