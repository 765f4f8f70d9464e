// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>

#include "core/error.h"
#include "export/ppm_writer.h"
#include "program_files.h"

namespace farop::app {
namespace {

const PictureLibrary& load() {
  const std::string path = library_file("farop-pictures.so");
  void* const handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const symbol = handle == nullptr ? nullptr : ::dlsym(handle, "farop_picture_library");
  if (symbol == nullptr) {
    const char* const reason = ::dlerror();
    throw Error(ExitStatus::internal,
                fmt::format("the picture library cannot be loaded: {}", reason == nullptr ? path : reason),
                "reinstall farop; PPM pictures do without that library");
  }
  return *reinterpret_cast<const PictureLibrary* (*)()>(symbol)();
}

}  // namespace

const PictureLibrary& picture_library() {
  static const PictureLibrary& library = load();
  return library;
}

void check_picture_path(const std::string& path) {
  if (!is_ppm_path(path)) picture_library().check_image_path(path);
}

void write_picture_file(const std::string& path, const Framebuffer& picture) {
  if (is_ppm_path(path)) return write_ppm(path, picture);
  picture_library().write_image(path, picture);
}

}  // namespace farop::app
