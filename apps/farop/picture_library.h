// SPDX-License-Identifier: GPL-3.0-or-later
// Picture files, with OpenImageIO loaded only when a format needs it.
//
// OpenImageIO brings some 260 shared libraries: 0.4 s and 130 MB at every start. So it sits in a library of
// our own that is opened with the first picture that is no PPM.
#pragma once

#include <string>

#include "core/framebuffer.h"
#include "export/image_compare.h"

namespace farop::app {

/// The functions of export/image_writer.h and export/image_compare.h, as that library exports them.
struct PictureLibrary {
  void (*check_image_path)(const std::string& path);
  void (*write_image)(const std::string& path, const Framebuffer& picture);
  void (*check_depth_path)(const std::string& path);
  void (*write_depth)(const std::string& path, const Framebuffer& picture);
  CompareResult (*compare_images)(const std::string& a, const std::string& b,
                                  const CompareThresholds& thresholds, const std::string& difference);
};

/// Opened when first called. Throws Error(ExitStatus::internal) when the installation is incomplete.
const PictureLibrary& picture_library();

/// check_image_path() and write_image() of export/image_writer.h; PPM does without the library.
void check_picture_path(const std::string& path);
void write_picture_file(const std::string& path, const Framebuffer& picture);

}  // namespace farop::app
