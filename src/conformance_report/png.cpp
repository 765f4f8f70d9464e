// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/png.h"

#include <png.h>

#include <string_view>
#include <vector>

namespace farop::conformance_report {
namespace {

std::string base64(const std::vector<unsigned char>& bytes) {
  constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const unsigned word = (unsigned{bytes[i]} << 16u) | (left > 1 ? unsigned{bytes[i + 1]} << 8u : 0u) |
                          (left > 2 ? unsigned{bytes[i + 2]} : 0u);
    for (unsigned k = 0; k < 4; ++k) out += k <= left ? k_digits[(word >> (18u - 6u * k)) & 63u] : '=';
  }
  return out;
}

}  // namespace

std::string png_data_url(const Framebuffer& picture) {
  if (picture.rgb.empty() || picture.width <= 0 || picture.height <= 0) return "";
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  const png_int_32 row_bytes = -3 * picture.width;  // negative: the last row of memory is the top one
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<unsigned char> bytes(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), row_bytes, nullptr) == 0)
    return "";
  bytes.resize(size);
  return "data:image/png;base64," + base64(bytes);
}

}  // namespace farop::conformance_report
