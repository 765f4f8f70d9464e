// SPDX-License-Identifier: GPL-3.0-or-later
// The other side of picture_library.h: the one part of the program that is linked with OpenImageIO.
#include "export/image_writer.h"
#include "picture_library.h"

extern "C" __attribute__((visibility("default"))) const farop::app::PictureLibrary* farop_picture_library() {
  static constexpr farop::app::PictureLibrary library = {farop::check_image_path, farop::write_image,
                                                         farop::check_depth_path, farop::write_depth,
                                                         farop::compare_images};
  return &library;
}
